// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// The mean of a cloud and the eigenvectors of its covariance, the widest direction first. The columns' signs
// are left as they come; LeafFrame fixes them.
struct PrincipalAxes {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;        // columns, orthonormal
  Eigen::Vector3d deviations;  // standard deviations along them, falling
};

// `left_out`: points not to be counted (1), as long as `points`. At least one point must remain.
PrincipalAxes FindPrincipalAxes(std::span<const Eigen::Vector3d> points,
                                const std::vector<std::uint8_t>& left_out);

}  // namespace frond
