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

// An integer, or `auto`, the default.
inline OptionSpec AutoIntegerSpec(const std::string& name, double minimum, double maximum,
                                  const std::string& help) {
  OptionSpec spec = IntegerSpec(name, 0, minimum, maximum, help);
  spec.default_value = std::string("auto");
  spec.words = {"auto"};
  return spec;
}

inline OptionSpec FlagSpec(const std::string& name, bool value, const std::string& help) {
  return {.name = name, .type = OptionType::kFlag, .default_value = value, .help = help};
}

// The first word is the default.
inline OptionSpec ChoiceSpec(const std::string& name, const std::vector<std::string>& words,
                             const std::string& help) {
  return {.name = name, .type = OptionType::kChoice, .default_value = words[0], .help = help, .words = words};
}

}  // namespace frond
