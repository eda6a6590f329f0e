// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/synth.h"

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "io/config_file.h"
#include "io/file_bytes.h"
#include "io/point_cloud_file.h"
#include "io/run_directory.h"
#include "problems/leaf/leaf_options.h"

namespace frond {
namespace {

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
  nlohmann::ordered_json rotation = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) {
    rotation.push_back({scan.pose.linear()(row, 0), scan.pose.linear()(row, 1), scan.pose.linear()(row, 2)});
  }
  const Eigen::Vector3d shift = scan.pose.translation();
  truth["pose_mm"] = {{"rotation", rotation}, {"translation", {shift.x(), shift.y(), shift.z()}}};
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

}  // namespace

const std::vector<SynthKind>& SynthKinds() {
  static const std::vector<SynthKind> kinds = {{.name = "leaf",
                                                .help = "A tea leaf of known shape, as a scanner sees it",
                                                .options = SyntheticLeafSpecs()}};
  return kinds;
}

std::filesystem::path Synthesise(const std::string& kind, const std::string& set, std::uint64_t seed,
                                 const std::filesystem::path& out, bool overwrite) {
  const SynthKind* known = nullptr;
  for (const SynthKind& candidate : SynthKinds()) {
    if (candidate.name == kind) known = &candidate;
  }
  if (known == nullptr) throw ConfigError("synth: unknown kind '" + kind + "'; known: leaf");
  ConfigFile config = ConfigFile::Parse("options: {}", "--set");
  if (!set.empty()) config.Override(set);
  Options options(known->options);
  config.ReadSection("", &options, {"options"});

  const std::filesystem::path target = out.empty() ? std::filesystem::path("runs") / ("synth_" + kind) : out;
  RunDirectory run(target, overwrite);
  WriteLeaf(options, seed, run);
  ResolvedConfig resolved;
  resolved.Add("kind", kind);
  resolved.Add("seed", static_cast<std::int64_t>(seed));
  resolved.AddSection("options", options);
  WriteFileBytes(run.File("config.yaml"), resolved.Yaml());
  run.Commit();
  return target;
}

}  // namespace frond
