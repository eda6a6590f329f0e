// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/run_input.h"

#include "base/errors.h"
#include "io/length_unit.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/voxel_grid.h"

namespace frond {

std::vector<OptionSpec> InputSpecs() {
  return {{.name = "cloud",
           .type = OptionType::kText,
           .default_value = std::string(),
           .help = "The scan: ply, pcd, xyz, asc, csv, txt, pts, obj, stl, off"},
          {.name = "synthetic_leaf",
           .type = OptionType::kInteger,
           .default_value = std::int64_t{0},
           .help = "Instead of a scan: the leaf of this seed, as `frond synth leaf` makes it",
           .minimum = 0},
          {.name = "truth",
           .type = OptionType::kText,
           .default_value = std::string(),
           .help = "Clean points of the same object: adds truth_rmse and truth_max"},
          {.name = "unit",
           .type = OptionType::kChoice,
           .default_value = std::string("mm"),
           .help = "Unit of the coordinates",
           .words = LengthUnitNames()},
          {.name = "points",
           .type = OptionType::kInteger,
           .default_value = std::int64_t{0},
           .help = "Thin to about this many by a voxel grid placed by the seed; 0: all",
           .minimum = 0}};
}

InputSource ReadInputSource(const ConfigFile& config) {
  Options options(InputSpecs());
  config.ReadSection("input", &options);
  const bool cloud = config.Has("input.cloud"), synthetic = config.Has("input.synthetic_leaf");
  if (cloud == synthetic) {
    config.Fail("input", cloud ? "name one of 'cloud' and 'synthetic_leaf', not both"
                               : "no input: name a scan, for example --set=\"input.cloud=scan.ply\"");
  }
  InputSource source;
  if (cloud) source.cloud = config.ResolvePath("input.cloud");
  if (synthetic) source.synthetic_leaf = static_cast<std::uint64_t>(config.Integer("input.synthetic_leaf"));
  if (config.Has("input.truth")) source.truth = config.ResolvePath("input.truth");
  source.unit = options.Text("unit");
  source.points = static_cast<std::size_t>(options.Integer("points"));
  return source;
}

void AddInput(const InputSource& source, ResolvedConfig* resolved) {
  if (source.synthetic_leaf) {
    resolved->Add("input.synthetic_leaf", static_cast<std::int64_t>(*source.synthetic_leaf));
  } else {
    resolved->Add("input.cloud", source.cloud.string());
  }
  if (!source.truth.empty()) resolved->Add("input.truth", source.truth.string());
  resolved->Add("input.unit", source.unit);
  if (source.points > 0) resolved->Add("input.points", static_cast<std::int64_t>(source.points));
}

RunInput LoadInput(const InputSource& source, std::uint64_t seed) {
  RunInput input;
  input.unit = source.unit;
  if (source.none()) {
    input.description = "no input";
    input.unit = "none";
    return input;
  }
  if (source.synthetic_leaf) {
    const std::uint64_t leaf = *source.synthetic_leaf;
    LeafScanOptions options;
    options.seed = leaf;
    options.unit_mm = MetresPerUnit(source.unit) * 1000;
    LeafScan scan = ScanLeaf(RandomLeaf(leaf), options);
    input.description = "synthetic leaf " + std::to_string(leaf);
    input.cloud.points = std::move(scan.points);
    input.truth = std::move(scan.dense_clean);
    input.true_area = scan.measures.area;
    input.report.format = "synthetic";
    input.report.rows = input.cloud.points.size();
  } else {
    input.description = source.cloud.string();
    input.cloud = ReadPointCloud(source.cloud, &input.report);
  }
  if (!source.truth.empty()) input.truth = ReadPointCloud(source.truth).points;
  if (source.points > 0 && source.points < input.cloud.points.size()) {
    input.cloud.points = DownsampleByVoxelGrid(input.cloud.points, source.points, seed);
  }
  return input;
}

}  // namespace frond
