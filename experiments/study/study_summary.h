// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/study/report_document.h"
#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"

namespace frond {

// What a study's reports hold, but for figures. Ids: answer, solvers, setup, speed-ups, pairs, ranks, digits,
// problems; a section that says nothing (pairs of a single solver) is left out.
std::vector<ReportSection> StudySections(const StudyPlan& plan, const StudyAnalysis& analysis);

// summary.md.
std::string StudyMarkdown(const StudyPlan& plan, const StudyAnalysis& analysis);

// For a terminal of 100 columns: the answer, the solvers, speed-ups, run-length distributions in characters.
std::string TerminalReport(const StudyPlan& plan, const StudyAnalysis& analysis);

}  // namespace frond
