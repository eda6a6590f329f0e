// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace frond {

// A matched window in space, in the disk's frame and unit.
struct ScanPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();     // unit, to the camera's side
  Eigen::Vector3d to_camera = Eigen::Vector3d::UnitX();  // unit: the ray's direction back to the left camera
  double sigma = 0;                                      // standard deviation along the ray
  std::array<std::uint8_t, 3> colour{128, 128, 128};
  int view = 0;       // number of the pair
  double cosine = 1;  // of the angle between normal and ray

  // Along the normal.
  double NormalSigma() const { return sigma * cosine; }
};

}  // namespace frond
