// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "models/kd_tree.h"

namespace frond {

// The surface of a cloud about one of its points: p + a x + b y + (f(a, b) − f(0, 0)) n, with a quadric f
// fitted to the neighbours. It passes through the point: the point's own noise goes along.
struct LocalQuadric {
  Eigen::Vector3d point, x, y, n;            // orthonormal axes, n across the surface
  Eigen::Matrix<double, 5, 1> coefficients;  // of a, b, a², ab, b² in f
  Eigen::Vector3d At(double a, double b) const;
};

// From the 20 nearest points with weights that fall off over two spacings, `tree` over `points`. None where
// they lie on a line or are fewer than 6.
std::optional<LocalQuadric> FitLocalQuadric(std::span<const Eigen::Vector3d> points, const KdTree& tree,
                                            const Eigen::Vector3d& point);

struct MovedPoint {
  Eigen::Vector3d position;
  double distance = 0;  // along the surface
};

// The point moved along its quadric, the steepest way, to where (x − origin) · normal = 0 (`normal` unit).
// None where the surface rises to the plane by less than 10 degrees or does not reach it within `reach`.
std::optional<MovedPoint> MoveToPlane(const LocalQuadric& quadric, const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& normal, double reach);

// The point of the quadric that is highest along `direction`, no further than `reach` from its point; the
// point itself where there is none.
Eigen::Vector3d HighestPoint(const LocalQuadric& quadric, const Eigen::Vector3d& direction, double reach);

}  // namespace frond
