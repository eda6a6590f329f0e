// SPDX-License-Identifier: BSD-3-Clause
// Ceres's own minimisers: `lm` (Levenberg–Marquardt), `dogleg` (Powell), `bfgs` and `lbfgs` (line search).
//
// They minimise the residual blocks, from the fit's start. The report's objective is that of the x returned;
// where the fit's objective is not the Ceres cost it is fit.Objective(x), evaluated also at every accepted
// iterate for the trace and the target. These extra evaluations measure, they do not drive the solver, and
// are not counted. As what is minimised is another function then, the result can be worse by the objective
// than an iterate before it (and than the trace's best), or than the start.
//
// Bounds are held by an active set around Ceres's own projection (active_bounds.h).
//
// No evaluation begins when the budget is used up, within an iteration (a line search) too: a solve is over
// it by less than one evaluation with its Jacobian. The first evaluation is always made.
#pragma once

#include "solvers/solver.h"

namespace frond {

SolverType LmSolverType();
SolverType DoglegSolverType();
SolverType BfgsSolverType();
SolverType LbfgsSolverType();  // of both, Solve throws ConfigError where a free parameter has a finite bound

}  // namespace frond
