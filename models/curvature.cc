// SPDX-License-Identifier: BSD-3-Clause
#include "models/curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace frond {

std::optional<SurfaceCurvature> CurvatureOf(const SurfacePoint& point) {
  const Eigen::Vector3d normal = point.Normal();
  if (normal.isZero(0)) return std::nullopt;
  const Eigen::Vector3d e1 = point.du.normalized();
  const Eigen::Vector3d e2 = normal.cross(e1);
  // [S_u S_v] = [e1 e2] A with A upper triangular; II in (e1, e2) is A⁻ᵀ II A⁻¹.
  const double a = point.du.norm(), b = point.dv.dot(e1), c = point.dv.dot(e2);
  const double l = point.duu.dot(normal), m = point.duv.dot(normal), n = point.dvv.dot(normal);
  Eigen::Matrix2d shape;
  shape(0, 0) = l / (a * a);
  shape(0, 1) = shape(1, 0) = (m - b * l / a) / (a * c);
  shape(1, 1) = (n - 2 * b * m / a + b * b * l / (a * a)) / (c * c);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(shape);  // eigenvalues rise
  SurfaceCurvature curvature;
  curvature.kappa1 = eigen.eigenvalues()[1];
  curvature.kappa2 = eigen.eigenvalues()[0];
  curvature.direction1 = (eigen.eigenvectors()(0, 1) * e1 + eigen.eigenvectors()(1, 1) * e2).normalized();
  curvature.direction2 = normal.cross(curvature.direction1);
  return curvature;
}

}  // namespace frond
