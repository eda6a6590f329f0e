// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "solvers/fit_problem.h"

namespace frond {

// The covariance of a fit's parameters at its solution x, for residuals whose standard deviation is 1:
// (JᵀJ)⁻¹ over all values of x, with zero rows and columns for constant blocks and what a manifold holds;
// times σ² of the residuals it is that of the parameters. Bounds are not looked at. Dense: for tens to a few
// hundreds of parameters. Throws FitError naming the block that the residuals do not determine.
Eigen::MatrixXd UnitCovariance(const FitProblem& fit, std::span<const double> x);

}  // namespace frond
