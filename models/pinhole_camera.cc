// SPDX-License-Identifier: BSD-3-Clause
#include "models/pinhole_camera.h"

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

// (a', b') of (a, b) and its Jacobian.
Eigen::Vector2d Distort(const std::array<double, 5>& d, const Eigen::Vector2d& p, Eigen::Matrix2d* jacobian) {
  const double a = p.x(), b = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double slope = d[0] + r2 * (2 * d[1] + r2 * 3 * d[4]);  // of `radial` by r²
  *jacobian << radial + 2 * a * a * slope + 2 * d[2] * b + 6 * d[3] * a,
      2 * a * b * slope + 2 * d[2] * a + 2 * d[3] * b, 2 * a * b * slope + 2 * d[2] * a + 2 * d[3] * b,
      radial + 2 * b * b * slope + 6 * d[2] * b + 2 * d[3] * a;
  return {a * radial + 2 * d[2] * a * b + d[3] * (r2 + 2 * a * a),
          b * radial + d[2] * (r2 + 2 * b * b) + 2 * d[3] * a * b};
}

}  // namespace

Eigen::Vector2d PinholeCamera::Project(const Eigen::Vector3d& point) const {
  Eigen::Vector2d pixel;
  ProjectPinhole(focal.data(), distortion.data(), point.data(), pixel.data());
  return pixel;
}

Eigen::Vector3d PinholeCamera::Ray(const Eigen::Vector2d& pixel) const {
  constexpr int kMaxIterations = 50;
  constexpr double kTolerance = 1e-12;
  const Eigen::Vector2d distorted((pixel.x() - focal[2]) / focal[0], (pixel.y() - focal[3]) / focal[1]);
  if (!HasDistortion()) return {distorted.x(), distorted.y(), 1};
  Eigen::Vector2d p = distorted;
  for (int i = 0; i < kMaxIterations; ++i) {
    Eigen::Matrix2d jacobian;
    const Eigen::Vector2d error = Distort(distortion, p, &jacobian) - distorted;
    if (!(jacobian.determinant() > 0)) break;
    p -= jacobian.inverse() * error;
    if (error.norm() <= kTolerance * (1 + distorted.norm())) return {p.x(), p.y(), 1};
  }
  throw InputError("the camera's distortion folds over at pixel (" + std::to_string(pixel.x()) + ", " +
                   std::to_string(pixel.y()) + "): calibrate with boards that reach the image's corners");
}

}  // namespace frond
