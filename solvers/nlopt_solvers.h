// SPDX-License-Identifier: BSD-3-Clause
// NLopt's local derivative-free algorithms as solvers: `nlopt.nelder_mead` (with bounds, Box 1965) and
// `nlopt.bobyqa` (Powell 2009). Called directly: Debian's pagmo is built without NLopt. They start at the
// fit's start, with a first step that is a share of the start box. Budgets are kept to the evaluation.
#pragma once

#include <vector>

#include "solvers/solver.h"

namespace frond {

// Solve throws ConfigError where nothing would ever stop it (tolerances of 0, a budget without limits);
// bobyqa's for a single free parameter, and a first step longer than half of the bounds' width.
std::vector<SolverType> NloptSolverTypes();

}  // namespace frond
