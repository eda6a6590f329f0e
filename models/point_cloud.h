// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace frond {

// A scan: points in the input's own unit and coordinates. Doubles throughout, because survey coordinates
// (UTM: 5.4e6 m) leave a float with half a metre.
struct PointCloud {
  std::vector<Eigen::Vector3d> points;
};

}  // namespace frond
