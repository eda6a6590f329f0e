// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solvers/solver.h"

namespace frond {

// `random_search`: the fit's start, then points uniform in its start box (or `start_box`); the best of all.
SolverType RandomSearchSolverType();

}  // namespace frond
