// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "experiments/study/study_analysis.h"

namespace frond {

// The axes of convergence plots.
inline double EvaluationsOf(const TracePoint& point) { return static_cast<double>(point.evaluations); }
inline double SecondsOf(const TracePoint& point) { return point.seconds; }

// Quartiles over runs of the best objective so far, at up to 64 places from the first to the last point of
// any run, evenly on a logarithmic axis. A run counts as its start before its first point (as infinite where
// that is not finite), and stays at its best after its end. Empty where no run has a trace.
ProblemSummary::Band ConvergenceBand(std::span<const JobResult* const> runs,
                                     double (*axis)(const TracePoint&));

}  // namespace frond
