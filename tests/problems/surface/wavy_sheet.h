// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// A small surface to try a fit's pieces on: control points near the plane z = 0 over [0, length_u] × [0,
// length_v], u along y and v along x as in a sheet's frame, each moved by up to `roughness` of its spacing.
struct WavySheet {
  int degree_u = 3, degree_v = 3;
  int count_u = 7, count_v = 8;
  bool uneven_knots = false;  // else uniform; the domain is then [0.5, 2] × [−1, 0.7]
  bool rational = false;      // weights within [0.6, 1.6]
  double length_u = 20, length_v = 50;
  double roughness = 0.3;
  std::uint64_t seed = 1;
};

NurbsSurface MakeSurface(const WavySheet& sheet);

// Clamped on [begin, end], inner knots at uneven distances.
BSplineBasis UnevenBasis(int degree, int count, double begin, double end);

// Points over the surface's whole domain, moved by normal noise; the last `beyond` of them lie off its edges
// and corners, so that their feet are held there.
std::vector<Eigen::Vector3d> PointsAround(const NurbsSurface& surface, int count, double noise, int beyond,
                                          std::uint64_t seed);

// On a grid over the unit square, jittered by up to 30 % of the spacing: no two closer than 0.4 of it.
std::vector<Eigen::Vector2d> JitteredSquare(int side, std::uint64_t seed);

}  // namespace frond
