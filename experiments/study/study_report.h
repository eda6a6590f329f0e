// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"

namespace frond {

// report.html: one file that needs no other and no script, to be read on a screen, a telephone or paper: the
// sections of StudySections with figures. The same bytes for the same analysis.
std::string StudyReportHtml(const StudyPlan& plan, const StudyAnalysis& analysis);

}  // namespace frond
