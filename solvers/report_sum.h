// SPDX-License-Identifier: BSD-3-Clause
// Several solves as one report.
#pragma once

#include "solvers/solver.h"

namespace frond {

// What a solve took, on top of what `total` says already.
inline void AddCost(const SolverReport& part, SolverReport* total) {
  total->evaluations += part.evaluations;
  total->residual_evaluations += part.residual_evaluations;
  total->jacobian_evaluations += part.jacobian_evaluations;
  total->seconds += part.seconds;
}

// A solve that went on where `total` ended: its trace follows, its end is the whole's. Not x.
inline void AppendStage(const SolverReport& stage, SolverReport* total) {
  for (TracePoint point : stage.trace) {
    point.evaluations += total->evaluations;
    point.seconds += total->seconds;
    total->trace.push_back(point);
  }
  total->objective = stage.objective;
  total->termination = stage.termination;
  total->message = stage.message;
  total->iterations += stage.iterations;
  AddCost(stage, total);
}

}  // namespace frond
