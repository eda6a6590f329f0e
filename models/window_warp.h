// SPDX-License-Identifier: BSD-3-Clause
// How a window of the left image is carried to the right one. Pixel (x + ξ, y + η) of the left image is seen
// at (x + ξ − u, y + η − v) of the right one, where u = x_left − x_right is the disparity:
//
//   shift      u = w0                                                            v = 0
//   linear     u = w0 + w1 ξ + w2 η                                              v = 0
//   quadratic  u = w0 + w1 ξ + w2 η + w3 ξ² + w4 ξη + w5 η²                      v = 0
//   affine     u = w0 + w1 ξ + w2 η,  v = w3 + w4 ξ + w5 η      (pairs that are not rectified)
//
// Pixels throughout. Every function takes doubles and ceres::Jets alike.
#pragma once

#include <array>

namespace frond {

enum class WarpKind { kShift, kLinear, kQuadratic, kAffine };

constexpr int kMaxWarpSize = 6;
using WarpValues = std::array<double, kMaxWarpSize>;  // those beyond WarpSize are zero

constexpr int WarpSize(WarpKind kind) {
  switch (kind) {
    case WarpKind::kShift:
      return 1;
    case WarpKind::kLinear:
      return 3;
    case WarpKind::kQuadratic:
    case WarpKind::kAffine:
      return 6;
  }
  return 0;
}

// Rectified pairs: the right image is sampled in the row of the left pixel.
constexpr bool StaysInRow(WarpKind kind) { return kind != WarpKind::kAffine; }

// u(ξ, η).
template <WarpKind kKind, typename T>
T WarpDisparity(const T* warp, double xi, double eta) {
  if constexpr (kKind == WarpKind::kShift) return warp[0];
  T u = warp[0];
  if constexpr (kKind != WarpKind::kShift) u += warp[1] * xi + warp[2] * eta;
  if constexpr (kKind == WarpKind::kQuadratic) {
    u += warp[3] * (xi * xi) + warp[4] * (xi * eta) + warp[5] * (eta * eta);
  }
  return u;
}

// v(ξ, η) of the affine warp.
template <typename T>
T WarpVerticalShift(const T* warp, double xi, double eta) {
  return warp[3] + warp[4] * xi + warp[5] * eta;
}

}  // namespace frond
