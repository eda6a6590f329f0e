// SPDX-License-Identifier: BSD-3-Clause
// Options of a solver inside another one's: `swarm_size` of `pso` is `pso.swarm_size` of `pso_lm`.
#pragma once

#include <string>
#include <vector>

#include "base/options.h"

namespace frond {

// The same specs, named "<prefix>.<name>".
std::vector<OptionSpec> WithPrefix(const std::string& prefix, std::vector<OptionSpec> specs);

// The options of `specs`, with those values that `options` was set to under "<prefix>.<name>".
Options WithoutPrefix(const std::string& prefix, const std::vector<OptionSpec>& specs,
                      const Options& options);

}  // namespace frond
