// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <array>

namespace frond {

// A pose as six parameters, (rotation vector ω, translation t): p ↦ exp(ω) R₀ p + t with R₀ of the start, so
// that ω stays small and away from its singularities. For double and ceres::Jet alike.
template <typename T>
void MoveByPose(const Eigen::Matrix3d& start_rotation, const T* pose, const T* point, T* moved) {
  T turned[3];
  for (int k = 0; k < 3; ++k) {
    turned[k] =
        start_rotation(k, 0) * point[0] + start_rotation(k, 1) * point[1] + start_rotation(k, 2) * point[2];
  }
  ceres::AngleAxisRotatePoint(pose, turned, moved);
  for (int k = 0; k < 3; ++k) moved[k] += pose[3 + k];
}

// The six parameters of the start itself, and the pose of any.
inline std::array<double, 6> PoseStart(const Eigen::Isometry3d& start) {
  return {0, 0, 0, start.translation().x(), start.translation().y(), start.translation().z()};
}

inline Eigen::Isometry3d PoseOf(const Eigen::Matrix3d& start_rotation, const double* pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = start_rotation.col(k);
    ceres::AngleAxisRotatePoint(pose, axis.data(), result.linear().col(k).data());
    result.translation()[k] = pose[3 + k];
  }
  return result;
}

}  // namespace frond
