// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "problems/curve/curve_fit.h"

namespace frond {

struct LocatedPoints {
  std::vector<std::size_t> order;  // along the curve, as indices of the points
  std::vector<double> parameters;  // in that order, not decreasing, first 0: up to 1, or below 1 if closed
  bool closed = false;
};

// Order and location parameters of points, eqs (15), (17), (19), or those of Ma's base curve: the points are
// projected on a line (their principal axis), a circle (in their principal plane; the angle about the centre
// of the least-squares circle) or a coarse curve through the chain of points, whose parameters they take;
// then base_repeats times on a coarse curve fitted to them with these. An open curve in a circle's order is
// cut at the largest gap. Throws InputError where the points coincide; ConfigError for a closed curve on a
// line.
LocatedPoints LocatePoints(std::span<const Eigen::Vector3d> points, const CurveFitOptions& options);

}  // namespace frond
