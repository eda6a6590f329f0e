// SPDX-License-Identifier: BSD-3-Clause
// Where knots and parameters come from. Equation numbers are those of Wu et al. 2021, appendix C.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/bspline_basis.h"

namespace frond {

// Clamped, uniform inside, on [begin, end]. count ≥ degree + 1 control points.
BSplineBasis UniformBasis(int degree, int count, double begin = 0, double end = 1);

// Periodic, uniform, on [begin, end], with `distinct` distinct control points (≥ degree + 1).
BSplineBasis PeriodicUniformBasis(int degree, int distinct, double begin = 0, double end = 1);

// How points of a row get their parameters: eqs (A4), (A5), (A6).
enum class Parametrisation { kUniform, kChord, kCentripetal };

// Periodic on [knots[0], knots[0] + period] with these knots, not decreasing, the seam's own among them: as
// many distinct control points as knots.
BSplineBasis PeriodicBasis(int degree, std::span<const double> knots, double period = 1);

// Parameters in [0, 1], first 0 and last 1. Throws InputError if the row has no length and the method needs
// one.
std::vector<double> Parametrise(std::span<const Eigen::Vector3d> points, Parametrisation method);

// The same for a closed row, the way from its last point back to the first included: in [0, 1), first 0.
std::vector<double> ParametriseClosed(std::span<const Eigen::Vector3d> points, Parametrisation method);

// Interpolation of parameters.size() points, eq. (A7): averages of `degree` neighbouring parameters.
BSplineBasis InterpolationBasis(int degree, std::span<const double> parameters);

// Approximation by `count` control points, eq. (A8): every span holds a parameter.
BSplineBasis ApproximationBasis(int degree, int count, std::span<const double> parameters);

}  // namespace frond
