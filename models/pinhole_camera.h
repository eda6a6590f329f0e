// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace frond {

// Projects p = (x, y, z), in the camera's frame (x to the right, y down, z away from the camera), to the
// pixel (u, v): with a = x/z, b = y/z, r² = a² + b² and distortion (k1, k2, p1, p2, k3), Brown's model as
// OpenCV has it:
//   a' = a (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 a b + p2 (r² + 2a²)
//   b' = b (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2b²) + 2 p2 a b
//   u = fx a' + cx,  v = fy b' + cy,  with focal = (fx, fy, cx, cy) in pixels.
// Only for z > 0; that is the caller's to see to. For double and ceres::Jet alike.
template <typename T>
void ProjectPinhole(const T* focal, const T* distortion, const T* p, T* pixel) {
  const T a = p[0] / p[2], b = p[1] / p[2];
  const T r2 = a * a + b * b;
  const T radial = T(1) + r2 * (distortion[0] + r2 * (distortion[1] + r2 * distortion[4]));
  const T ab = a * b;
  const T a_distorted = a * radial + T(2) * distortion[2] * ab + distortion[3] * (r2 + T(2) * a * a);
  const T b_distorted = b * radial + distortion[2] * (r2 + T(2) * b * b) + T(2) * distortion[3] * ab;
  pixel[0] = focal[0] * a_distorted + focal[2];
  pixel[1] = focal[1] * b_distorted + focal[3];
}

// A pinhole camera with distortion. Lengths in pixels.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  std::array<double, 4> focal{1, 1, 0, 0};          // fx, fy, cx, cy
  std::array<double, 5> distortion{0, 0, 0, 0, 0};  // k1, k2, p1, p2, k3

  bool HasDistortion() const { return distortion != std::array<double, 5>{0, 0, 0, 0, 0}; }

  // The pixel of a point in the camera's frame with z > 0.
  Eigen::Vector2d Project(const Eigen::Vector3d& point) const;

  // The direction (x/z, y/z, 1) that is seen at `pixel`: the distortion undone by Newton's method, to 1e-12.
  // Throws InputError where that does not converge (a distortion that folds over within the image).
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace frond
