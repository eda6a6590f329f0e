// SPDX-License-Identifier: BSD-3-Clause
// The common kinds of OptionSpec in one line each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/options.h"

namespace frond {

inline OptionSpec NumberSpec(const std::string& name, double value, double minimum, double maximum,
                             const std::string& help) {
  return {.name = name,
          .type = OptionType::kNumber,
          .default_value = value,
          .help = help,
          .minimum = minimum,
          .maximum = maximum};
}

inline OptionSpec IntegerSpec(const std::string& name, std::int64_t value, double minimum, double maximum,
                              const std::string& help) {
  return {.name = name,
          .type = OptionType::kInteger,
          .default_value = value,
          .help = help,
          .minimum = minimum,
          .maximum = maximum};
}

// The first word is the default.
inline OptionSpec ChoiceSpec(const std::string& name, const std::vector<std::string>& words,
                             const std::string& help) {
  return {.name = name, .type = OptionType::kChoice, .default_value = words[0], .help = help, .words = words};
}

}  // namespace frond
