// SPDX-License-Identifier: BSD-3-Clause
#include "io/number_text.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace frond {

std::size_t ParseNumber(std::string_view text, double* value) {
  const char* const first = text.data();
  const char* const last = first + text.size();
  const char* begin = first;
  if (begin != last && *begin == '+') {
    ++begin;
    if (begin != last && *begin == '-') return 0;
  }
  const auto result = std::from_chars(begin, last, *value);
  if (result.ec == std::errc::invalid_argument) return 0;
  if (result.ec == std::errc::result_out_of_range) {
    // Too large or too small: the sign of the decimal exponent tells which ("1e-400" is zero).
    const std::string_view taken(begin, static_cast<std::size_t>(result.ptr - begin));
    const std::size_t exponent = taken.find_first_of("eE");
    const bool small = exponent != std::string_view::npos
                           ? taken.substr(exponent + 1).starts_with('-')
                           : taken.find_first_of("123456789") > taken.find('.');
    const double magnitude = small ? 0.0 : std::numeric_limits<double>::infinity();
    *value = taken.starts_with('-') ? -magnitude : magnitude;
  }
  return static_cast<std::size_t>(result.ptr - first);
}

void AppendNumber(double value, std::string* text) {
  if (value == 0 && std::signbit(value)) {
    *text += "-0.0";
    return;
  }
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  text->append(buffer, end);
}

std::string FormatNumber(double value) {
  std::string text;
  AppendNumber(value, &text);
  return text;
}

}  // namespace frond
