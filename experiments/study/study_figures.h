// SPDX-License-Identifier: BSD-3-Clause
// The figures of a study's report, each with a caption that says how to read it and its data at the ticks as
// a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/study/report_document.h"
#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"

namespace frond {

struct ReportFigure {
  std::string svg, caption;
  Table data;
};

// Run-length distributions, data profiles, performance profiles by evaluations and by seconds.
std::vector<ReportFigure> ProfileFigures(const StudyPlan& plan, const StudyAnalysis& analysis);

// The critical-difference diagram; none for fewer than two solvers.
std::vector<ReportFigure> RankFigures(const StudyAnalysis& analysis);

// Best objective so far on problem `problem`, median and quartiles: by evaluations and by seconds.
std::vector<ReportFigure> ConvergenceFigures(const StudyAnalysis& analysis, std::size_t problem);

// The value of steps at x: that of the last point not right of x, `before` left of the first.
double StepValueAt(const Curve& curve, double x, double before);

}  // namespace frond
