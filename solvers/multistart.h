// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solvers/solver.h"

namespace frond {

// `multistart_lm`: Levenberg–Marquardt from the fit's start, then from points drawn in its start box (or
// `start_box`), until the budget is used up, the target reached or `starts` are done; the best of all.
// Progress may stall inside a descent, or by the evaluations of several.
// Options of the descents are `lm.max_iterations`, …
SolverType MultistartLmSolverType();

}  // namespace frond
