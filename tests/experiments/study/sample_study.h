// SPDX-License-Identifier: BSD-3-Clause
// Studies made by hand, to see what reports make of them.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"

namespace frond {

struct SampleStudy {
  StudyPlan plan;
  StudyAnalysis analysis;
};

// Contenders lm, paper_pso and one called kOddName on the problems misra1a and boxbod (whose least is
// published), 15 repetitions: every number of it is different from all others where it can be.
inline const std::string kOddName = "<b>&\"|";
SampleStudy MadeStudy();

// One contender on one problem.
SampleStudy LoneStudy();

// Two contenders without any success; with `failed`, without any result.
SampleStudy HopelessStudy(bool failed);

// Whether every element of `markup` that is opened is closed, in order, all attributes are quoted and every &
// starts an entity.
bool IsWellFormed(const std::string& markup);

}  // namespace frond
