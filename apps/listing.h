// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace frond {

// `frond list`: solvers, fits, synthetic scans and formats, a line each; with `what` the name of one of them:
// its options with defaults, ranges and help. Throws ConfigError for an unknown name.
void PrintList(const std::string& what, std::ostream& out);

}  // namespace frond
