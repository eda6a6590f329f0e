// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/bspline_basis.h"
#include "problems/curve/curve_fit.h"

namespace frond {

// options.knot_multiplicity, or what it stands for with `control_points` (distinct ones).
int KnotMultiplicity(const CurveFitOptions& options, int control_points, bool closed);

// Why `control_points` (distinct ones) do not make a knot vector, and what would; empty where they do.
std::string KnotCountFault(const CurveFitOptions& options, int control_points, bool closed);

// Knots of a curve with options.control_points (distinct) control points at points with these location
// parameters, in order: [0, 1] for an open curve, [0, 1) for a closed one, whose domain begins at its first
// knot.
//
//  kUniform    eq. (20)
//  kAveraging  (A8), with as many control points as points (A7); for a closed curve the same around its seam
//  kMa         the parameters in as many groups, of equal numbers, as control points; (A7) of the groups'
//              averages, so that all parameters count
//  kRefine     least squares with few spans; then a knot more, in the middle (by number) of the parameters of
//              the span with the largest distance, until all control points are used, options.tolerance is
//              met or no such span holds four points
//
// Throws InputError where fewer parameters than control points differ.
BSplineBasis PlaceKnots(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                        bool closed, const CurveFitOptions& options);

}  // namespace frond
