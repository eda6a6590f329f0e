// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/set_scans.h"

#include "base/errors.h"
#include "base/option_specs.h"
#include "io/length_unit.h"

namespace frond {

std::vector<OptionSpec> SetScanSpecs(std::int64_t points) {
  return {
      {.name = "leaves",
       .type = OptionType::kIntegers,
       .default_value = std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8},
       .help = "Seeds of synthetic leaves, a problem each",
       .minimum = 0,
       .maximum = 1e9,
       .min_size = 1,
       .max_size = 10000},
      {.name = "cloud", .type = OptionType::kText, .default_value = std::string(), .help = "A scan instead"},
      {.name = "unit", .type = OptionType::kText, .default_value = std::string("mm"), .help = "Of the scan"},
      IntegerSpec("points", points, 0, 1e9, "Thin to about this many by a voxel grid; 0: all")};
}

std::vector<SetScan> SetScansFrom(const Options& options) {
  InputSource source;
  source.unit = options.Text("unit");
  (void)MetresPerUnit(source.unit);  // throws for an unknown one
  source.points = static_cast<std::size_t>(options.Integer("points"));
  if (!options.Text("cloud").empty()) {
    if (options.IsSet("leaves")) throw ConfigError("name one of 'leaves' and 'cloud', not both");
    source.cloud = options.Text("cloud");
    return {{"cloud", source}};
  }
  std::vector<SetScan> scans;
  for (const int leaf : options.Integers("leaves")) {
    source.synthetic_leaf = static_cast<std::uint64_t>(leaf);
    scans.push_back({"leaf_" + std::to_string(leaf), source});
  }
  return scans;
}

}  // namespace frond
