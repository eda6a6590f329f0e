// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/synth.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/errors.h"
#include "experiments/synth_turntable.h"
#include "io/config_file.h"
#include "io/file_bytes.h"
#include "io/point_cloud_file.h"
#include "io/run_directory.h"
#include "problems/leaf/leaf_options.h"
#include "problems/surface/analytic_patch.h"

namespace frond {
namespace {

constexpr char kTurntable[] = "turntable";

nlohmann::ordered_json PoseJson(const Eigen::Isometry3d& pose) {
  nlohmann::ordered_json rotation = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) {
    rotation.push_back({pose.linear()(row, 0), pose.linear()(row, 1), pose.linear()(row, 2)});
  }
  const Eigen::Vector3d shift = pose.translation();
  return {{"rotation", rotation}, {"translation", {shift.x(), shift.y(), shift.z()}}};
}

std::string TruthJson(const LeafScan& scan, std::uint64_t seed, const std::string& unit,
                      const LeafShape& shape) {
  nlohmann::ordered_json truth;
  truth["schema"] = "frond.leaf_truth/1";
  truth["seed"] = seed;
  truth["unit"] = unit;
  truth["character"] = LeafCharacterName(shape.character);
  truth["measures"] = {{"area", scan.measures.area},
                       {"scanned_area", scan.scanned_area},
                       {"length", scan.measures.length},
                       {"midrib_length", scan.measures.midrib_length},
                       {"width", scan.measures.width},
                       {"perimeter", scan.measures.perimeter},
                       {"perimeter_smooth", scan.measures.perimeter_smooth}};
  truth["pose_mm"] = PoseJson(scan.pose);
  truth["parameters"] = scan.values;
  return truth.dump(2) + "\n";
}

void WriteLeaf(const Options& options, std::uint64_t seed, const RunDirectory& run) {
  const LeafShape shape = LeafShapeFrom(options, seed);
  const LeafScan scan = ScanLeaf(shape, LeafScanOptionsFrom(options, seed));
  WritePointCloud(run.File("scan.ply"), {scan.points});
  WritePointCloud(run.File("clean.ply"), {scan.clean_points});
  WritePointCloud(run.File("truth.ply"), {scan.dense_clean});
  WriteFileBytes(run.File("truth.json"), TruthJson(scan, seed, options.Text("unit"), shape));
}

void WriteAnalyticPatch(AnalyticShape shape, const Options& options, std::uint64_t seed,
                        const RunDirectory& run) {
  const AnalyticPatch patch = AnalyticPatchFrom(shape, options);
  const AnalyticScan scan = ScanAnalyticPatch(patch, AnalyticScanOptionsFrom(options, seed));
  WritePointCloud(run.File("scan.ply"), {scan.points});
  WritePointCloud(run.File("clean.ply"), {scan.clean_points});
  nlohmann::ordered_json truth;
  truth["schema"] = "frond.patch_truth/1";
  truth["shape"] = AnalyticShapeNames()[static_cast<std::size_t>(shape)];
  truth["seed"] = seed;
  truth["pose"] = PoseJson(scan.pose);
  WriteFileBytes(run.File("truth.json"), truth.dump(2) + "\n");
}

// The shape of that name, or none.
std::optional<AnalyticShape> ShapeNamed(const std::string& kind) {
  const auto& names = AnalyticShapeNames();
  const auto found = std::find(names.begin(), names.end(), kind);
  if (found == names.end()) return std::nullopt;
  return static_cast<AnalyticShape>(found - names.begin());
}

}  // namespace

const std::vector<SynthKind>& SynthKinds() {
  static const std::vector<SynthKind> kinds = [] {
    std::vector<SynthKind> all = {{.name = "leaf",
                                   .help = "A tea leaf of known shape, as a scanner sees it",
                                   .options = SyntheticLeafSpecs()}};
    for (const std::string& name : AnalyticShapeNames()) {
      all.push_back({.name = name,
                     .help = "An open patch of a " + name + ", exact or with noise",
                     .options = AnalyticPatchSpecs(*ShapeNamed(name))});
    }
    all.push_back({.name = kTurntable,
                   .help = "Photographs of a pear and of a board on a turning disk",
                   .options = SynthTurntableSpecs()});
    return all;
  }();
  return kinds;
}

namespace {
std::string KnownKinds() {
  std::string names;
  for (const SynthKind& kind : SynthKinds()) names += " " + kind.name;
  return names;
}
}  // namespace

std::filesystem::path Synthesise(const std::string& kind, const std::string& set, std::uint64_t seed,
                                 const std::filesystem::path& out, bool overwrite, int threads) {
  const SynthKind* known = nullptr;
  for (const SynthKind& candidate : SynthKinds()) {
    if (candidate.name == kind) known = &candidate;
  }
  if (known == nullptr) throw ConfigError("synth: unknown kind '" + kind + "'; known:" + KnownKinds());
  ConfigFile config = ConfigFile::Parse("options: {}", "--set");
  if (!set.empty()) config.Override(set);
  Options options(known->options);
  config.ReadSection("", &options, {"options"});

  const std::filesystem::path target = out.empty() ? std::filesystem::path("runs") / ("synth_" + kind) : out;
  RunDirectory run(target, overwrite);
  if (const auto shape = ShapeNamed(kind)) {
    WriteAnalyticPatch(*shape, options, seed, run);
  } else if (kind == kTurntable) {
    WriteSynthTurntable(options, seed, threads, run);
  } else {
    WriteLeaf(options, seed, run);
  }
  ResolvedConfig resolved;
  resolved.Add("kind", kind);
  resolved.Add("seed", static_cast<std::int64_t>(seed));
  resolved.AddSection("options", options);
  WriteFileBytes(run.File("config.yaml"), resolved.Yaml());
  run.Commit();
  return target;
}

}  // namespace frond
