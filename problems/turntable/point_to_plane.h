// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/rotation.h>

#include <Eigen/Core>
#include <vector>

#include "problems/turntable/overlap_pairs.h"

namespace frond {

// Row i: r = share · (R_b n) · (T_a p − T_b q) / σ, with p of view a, q and its normal n of view b, and the
// views' motions T x = centre + R (x − centre) + t. Parameter blocks: a's motion, b's; 6 values each, R's
// axis times its angle (radians), then t; or 1, the angle about z.
template <int kSize>
struct PointToPlaneResidual {
  const std::vector<PlaneRow>* rows;
  Eigen::Vector3d centre;
  double share = 1;  // √ of what a row counts as

  template <typename T>
  bool operator()(int i, const T* first, const T* second, T* residual) const {
    const PlaneRow& row = (*rows)[static_cast<std::size_t>(i)];
    T p[3], q[3], n[3];
    Rotate(first, row.point - centre, p);
    Rotate(second, row.foot - centre, q);
    Rotate(second, row.normal, n);
    residual[0] = T(0);
    for (int k = 0; k < 3; ++k) {
      T gap = p[k] - q[k];
      if constexpr (kSize == 6) gap += first[3 + k] - second[3 + k];
      residual[0] += n[k] * gap;
    }
    residual[0] *= share / row.sigma;
    return true;
  }

 private:
  template <typename T>
  static void Rotate(const T* motion, const Eigen::Vector3d& vector, T* rotated) {
    const T turn[3] = {kSize == 6 ? motion[0] : T(0), kSize == 6 ? motion[kSize == 6 ? 1 : 0] : T(0),
                       motion[kSize == 6 ? 2 : 0]};
    const T v[3] = {T(vector.x()), T(vector.y()), T(vector.z())};
    ceres::AngleAxisRotatePoint(turn, v, rotated);
  }
};

}  // namespace frond
