// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "problems/standard/more_wild_fit.h"
#include "problems/standard/problem_set.h"

namespace frond {

// The 53 problems of Moré and Wild (2009), in the order of their supplement's dfo.dat.
std::span<const MoreWildRow> MoreWildRows();

// `more_wild`: those rows as MoreWildFit, named by row, function, n and start: "mw01_linear_full_rank_9",
// "mw02_linear_full_rank_9_x10".
//
// best_objective is half of the least sum of squares there is: 0 or a closed form for systems and linear
// functions, else the value of Moré, Garbow and Hillstrom (1981), polished by Newton's method in 45 digits;
// for BDQRTIC, which is convex, found so. None for Chebyquad with n = 11, of which neither paper gives one.
// Freudenstein and Roth's, Bard's, Kowalik and Osborne's and Brown's almost linear function have other minima
// or infima (48.98, 17.43, 1.027e-3 and 1 before halving). best_x is given where it is unique and closed.
ProblemSetType MoreWildSetType();

}  // namespace frond
