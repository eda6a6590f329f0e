// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/problem_choice.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "problems/standard/lower_case.h"

namespace frond {

OptionSpec ProblemChoiceSpec(const std::string& help) {
  return {.name = "problem", .type = OptionType::kText, .default_value = std::string("all"), .help = help};
}

std::vector<std::size_t> ChosenProblems(const Options& options, const std::vector<std::string>& names) {
  const std::string wanted = LowerCase(options.Text("problem"));
  if (wanted == "all") {
    std::vector<std::size_t> every(names.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    return every;
  }
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end()) return {static_cast<std::size_t>(found - names.begin())};
  std::string all = "all";
  for (const std::string& name : names) all += ", " + name;
  const std::string nearest = NearestWord(wanted, names);
  throw ConfigError("unknown problem '" + options.Text("problem") + "'" +
                    (nearest.empty() ? ", expected one of " + all : " (did you mean '" + nearest + "'?)"));
}

}  // namespace frond
