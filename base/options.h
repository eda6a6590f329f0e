// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace frond {

using OptionRows = std::vector<std::vector<double>>;

// A value as it stands in a config: `true`, `3`, `0.5`, `centripetal`, `[3, 3]`, `[[0, 0, 1], [0, 1, 0]]`.
using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, OptionRows>;

// What an option accepts. kChoice is one of `words`; kInteger … kRows also accept one of `words` (for
// example `auto` beside a pair of integers). Lists hold `min_size` to `max_size` values; kRows are as many
// lists of `row_size` numbers each.
enum class OptionType { kFlag, kInteger, kNumber, kText, kChoice, kIntegers, kNumbers, kRows };

// One option of a fit or solver, declared once: configs are validated, `frond list` is printed and the docs
// are written from it. `name` is dotted where the config has sections: "surface.control_points".
struct OptionSpec {
  std::string name;
  OptionType type = OptionType::kNumber;
  OptionValue default_value = 0.0;
  std::string help;
  double minimum = -std::numeric_limits<double>::infinity();  // bounds of every value, inclusive
  double maximum = std::numeric_limits<double>::infinity();
  std::vector<std::string> words = {};
  std::size_t min_size = 1;  // lists only
  std::size_t max_size = 1;
  std::size_t row_size = 0;  // kRows only
};

// "integer in [1, 20]", "one of uniform, chord", …: what `spec` accepts, in words.
std::string DescribeAccepted(const OptionSpec& spec);

// "0.05", "[3, 3]", "chord": the value as a config would write it.
std::string FormatValue(const OptionValue& value);

// The word of `candidates` nearest to `word` by edit distance, or "" if none is near enough to be a typo.
std::string NearestWord(std::string_view word, std::span<const std::string> candidates);

// The values of one section (a fit's, a solver's): defaults from its specs, overridden by Set.
class Options {
 public:
  explicit Options(std::vector<OptionSpec> specs);

  // Throws ConfigError that names the option (with the nearest known one) or the value and what is accepted.
  // An integer is accepted where a number is asked for, a single value where a list of any length is, and a
  // single row where rows are.
  void Set(const std::string& name, OptionValue value);

  bool IsSet(const std::string& name) const;  // set by Set, not a default
  const std::vector<OptionSpec>& specs() const { return specs_; }
  const OptionValue& Value(const std::string& name) const;

  // Typed access; std::logic_error where `name` is not an option of that type.
  bool Flag(const std::string& name) const;
  int Integer(const std::string& name) const;
  double Number(const std::string& name) const;
  const std::string& Text(const std::string& name) const;  // kText, kChoice
  bool HoldsWord(const std::string& name) const;           // a word where numbers could stand
  std::vector<int> Integers(const std::string& name) const;
  const std::vector<double>& Numbers(const std::string& name) const;
  const OptionRows& Rows(const std::string& name) const;

 private:
  const OptionSpec& Spec(const std::string& name) const;

  std::vector<OptionSpec> specs_;
  std::map<std::string, OptionValue> values_;
};

}  // namespace frond
