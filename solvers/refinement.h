// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solvers/fit_problem.h"

namespace frond {

// Digits that the cost cannot see. Near a minimum the cost changes by the square of the step: steps below the
// root of the rounding, about 1e-8 of x, neither lower nor raise it, and a method that asks the cost stops
// there. The steps themselves are still known. From a converged x this takes Gauss–Newton steps δ = −J⁺r (QR
// with column pivoting) for as long as each is shorter than 0.9 times the one before, by |D δ| with D the
// norms of J's columns.
//
// Starts only where the first step is short (|D δ| ≤ 1e-3 |D x|). Gives the cost of the x it moved to; none,
// with x where it was, where it did not move or the cost in the end is not finite or above (1 + 1e-9)
// `best_cost`. Each step is an evaluation with Jacobian; the end, where it comes with no other step, one
// without. No bounds, no manifolds. Throws EvaluationRefused as the gate does; x is then where the last step
// left it.
std::optional<double> RefineByGaussNewton(double best_cost, LeastSquares* least_squares);

}  // namespace frond
