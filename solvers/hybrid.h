// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solvers/solver.h"

namespace frond {

// `pso_lm`: a particle swarm for `pso_share` of the budget, then Levenberg–Marquardt from its best for the
// rest. Counts and trace are joined; the result is the better of both by the fit's objective. A swarm
// whose progress has stalled (Budget::stall_evaluations) ends the solve: nothing descends. Options of the two
// are `pso.swarm_size`, `lm.max_iterations`, …
SolverType PsoLmSolverType();

}  // namespace frond
