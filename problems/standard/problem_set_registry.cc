// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/errors.h"
#include "problems/standard/function_set.h"
#include "problems/standard/more_wild_set.h"
#include "problems/standard/nist_set.h"
#include "problems/standard/problem_set.h"

namespace frond {

const std::vector<ProblemSetType>& StandardSetTypes() {
  static const std::vector<ProblemSetType> types = [] {
    std::vector<ProblemSetType> list = {
        FunctionSetType(),
        MoreWildSetType(),
        NistSetType(),
    };
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return list;
  }();
  return types;
}

const ProblemSetType& FindProblemSetType(std::span<const ProblemSetType> types, const std::string& name) {
  std::vector<std::string> names;
  std::string all;
  for (const ProblemSetType& type : types) {
    if (type.name == name) return type;
    names.push_back(type.name);
    all += (all.empty() ? "" : ", ") + type.name;
  }
  const std::string nearest = NearestWord(name, names);
  throw ConfigError("unknown problem set '" + name + "'" +
                    (nearest.empty() ? ", expected one of " + all : " (did you mean '" + nearest + "'?)"));
}

}  // namespace frond
