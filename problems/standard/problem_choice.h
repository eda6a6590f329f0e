// SPDX-License-Identifier: BSD-3-Clause
// The option `problem` of a set: all of its problems, or one by name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/options.h"

namespace frond {

OptionSpec ProblemChoiceSpec(const std::string& help);  // "problem", text, default "all"

// The indices of `names` (lower case) that the option chooses: every one, or the one that it names in either
// case. Throws ConfigError with the nearest name.
std::vector<std::size_t> ChosenProblems(const Options& options, const std::vector<std::string>& names);

}  // namespace frond
