// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace frond {

// Sets the gflags named in argv, in the forms --flag=value, --flag value, --flag and --noflag, and returns
// the other arguments. The values of several --set are joined by ';'; of any other flag the last one holds.
// Throws ConfigError for an unknown flag (naming the nearest) or a bad value, where gflags itself would leave
// the program with a code of its own.
std::vector<std::string> ParseFlags(int argc, char** argv);

}  // namespace frond
