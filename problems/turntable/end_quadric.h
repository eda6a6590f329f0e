// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "problems/turntable/silhouette_planes.h"

namespace frond {

// A surface of second order that ends a closed body along x:
//   F = xᵀ A x + 2 b · x + c = 0, growing outwards.
struct EndQuadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;

  // x at (y, z) where F grows towards the end at −x (`end` −1) or +x (+1).
  std::optional<double> At(double y, double z, double end) const;
};

// Through points, by least squares of F with A_yy + A_zz = 2. None of fewer than 40 points.
std::optional<EndQuadric> QuadricThrough(std::span<const Eigen::Vector3d> points);

// The ellipsoid that touches planes, by least squares of its dual form (Cross and Zisserman 1998)
//   h² − 2h b* · n + nᵀ A* n = 0 for a plane n · x = h.
// None of fewer than 100 planes, where it is no ellipsoid, or where the planes miss it by more than 1/200 of
// the distance of its centre from them (root mean square).
std::optional<EndQuadric> QuadricTouching(std::span<const TangentPlane> planes);

}  // namespace frond
