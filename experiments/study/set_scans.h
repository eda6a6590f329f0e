// SPDX-License-Identifier: BSD-3-Clause
// The scans that a problem set over scans is made of: the options `leaves`, `cloud`, `unit` and `points`.
#pragma once

#include <string>
#include <vector>

#include "base/options.h"
#include "experiments/run_input.h"

namespace frond {

struct SetScan {
  std::string name;  // "leaf_3", or "cloud"
  InputSource source;
};

// `points`: the default of the option.
std::vector<OptionSpec> SetScanSpecs(std::int64_t points);

// One a leaf, or the cloud. Throws ConfigError where both are named.
std::vector<SetScan> SetScansFrom(const Options& options);

}  // namespace frond
