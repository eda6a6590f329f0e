// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/standard/problem_set.h"

namespace frond {

// `functions`: the functions of analytic_functions.h as AnalyticFit, named "rosenbrock_10" by function and
// dimension, "rosenbrock_10_shifted_rotated_3" where placed by an instance.
//
// best_objective is 0 and best_x the minimiser. resolution is 1e-12 a dimension: rounding reaches 1e-13 a
// term (Schwefel's, differences of numbers near 419), and less for the others; no local minimum but the
// global ones lies below 1e-3.
ProblemSetType FunctionSetType();

}  // namespace frond
