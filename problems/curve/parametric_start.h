// SPDX-License-Identifier: BSD-3-Clause
// Linear fits of a curve at fixed location parameters: eqs (22) and (24)–(26) of Moustakides et al.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_curve.h"

namespace frond {

// The least squares of eq. (22) in the control points, weights given (of all control points; empty: all 1),
// plus λ N ∫|P″|² dt, t over [0, 1]. Where points leave control points undetermined, λ is raised until they
// are determined. Throws FitError where that does not help.
NurbsCurve FitCurveAtParameters(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                                const BSplineBasis& basis, double fairness,
                                const std::vector<double>& weights = {});

// Ma's first step: eq. (25) without its control points, which are linear in the weights, is eq. (26), M w =
// 0. The weights (of all control points, mean 1) that minimise the quotient wᵀMw / (Σw)² with every w at
// least 0.05 of the mean: a convex problem, solved by active sets. His second step is FitCurveAtParameters
// with them.
std::vector<double> MaWeights(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                              const BSplineBasis& basis);

}  // namespace frond
