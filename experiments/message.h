// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace frond {

// "frond: MESSAGE" and a line end on stderr, where all errors and warnings go: control characters, which
// names of files may hold, become '?'.
void PrintMessage(std::string message);

}  // namespace frond
