// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_sets.h"

#include <algorithm>

namespace frond {

const std::vector<ProblemSetType>& StudySetTypes() {
  static const std::vector<ProblemSetType> types = [] {
    std::vector<ProblemSetType> list = StandardSetTypes();
    list.push_back(LeafWeightsSetType());
    list.push_back(SheetSetType());
    list.push_back(StereoWindowsSetType());
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return list;
  }();
  return types;
}

}  // namespace frond
