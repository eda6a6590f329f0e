// SPDX-License-Identifier: BSD-3-Clause
// pagmo's population-based algorithms (Biscani and Izzo 2020) as solvers: `pagmo.pso` (each particle learns
// from those moved before it), `pagmo.pso_gen` (by generations, in parallel), `pagmo.cmaes`, `pagmo.sade`,
// `pagmo.de1220`, `pagmo.bee_colony`.
//
// pagmo needs a finite box to search: the fit's bounds, and for values without any the start box (CMA-ES may
// leave it there). The first population is drawn in the start box, its first member put at the fit's start.
// Budgets are kept to the evaluation, by leaving pagmo through an exception; of pso_gen to the batch. A
// population that meets the algorithm's own tolerances has converged.
#pragma once

#include <vector>

#include "solvers/solver.h"

namespace frond {

std::vector<SolverType> PagmoSolverTypes();

}  // namespace frond
