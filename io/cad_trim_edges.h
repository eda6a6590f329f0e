// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// A polyline in (u, v), carried onto a surface exactly: where surface cells are polynomials of degree (p, q),
// a straight line's image is one of degree p + q (over a weight of the same degree). The curve's parameter is
// k + t on the way from vertex k to vertex k + 1.
struct CurveOnSurface {
  int degree = 1;
  std::vector<double> breaks;  // parameters of the pieces' ends: the vertices and crossings of knot lines
  std::vector<Eigen::Vector3d> control_points;  // degree × pieces + 1, Bézier pieces joined
  std::vector<double> weights;                  // as many; all 1 where the surface is not rational
};

CurveOnSurface ComposePolyline(const NurbsSurface& surface, std::span<const Eigen::Vector2d> polyline);

}  // namespace frond
