// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "models/kd_tree.h"

namespace frond {

// The scan's own noise: the median, over up to 2,000 points, of the RMS residual of a quadratic height field
// (6 coefficients) fitted to the 24 nearest neighbours in their own principal plane. A floor for any fit's
// RMSE. `outlier`: 1 for points that do not count. 0 where there are fewer than 25 points.
double LocalNoise(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& outlier,
                  const KdTree& tree);

}  // namespace frond
