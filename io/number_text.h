// SPDX-License-Identifier: BSD-3-Clause
// Numbers to and from text, independent of the locale.
#pragma once

#include <string>
#include <string_view>

namespace frond {

// Reads a number from the start of `text` (blanks are not skipped, a leading '+' is) and returns how many
// characters it took, 0 if there is none. "nan" and "inf" are numbers; one too large for a double is
// infinite.
std::size_t ParseNumber(std::string_view text, double* value);

// The shortest text that reads back to the same bits; a negative zero keeps its sign ("-0.0").
void AppendNumber(double value, std::string* text);
std::string FormatNumber(double value);

}  // namespace frond
