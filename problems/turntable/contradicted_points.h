// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "problems/turntable/view_merge.h"

namespace frond {

// 1 for points that one view alone saw and others saw elsewhere: on the view's own ray (`to_camera`, by
// point, unit) lies a surface of several views that faces the same way, in front of the point (which could
// not have been seen then) or less than 8 spacings behind it.
std::vector<std::uint8_t> ContradictedPoints(const std::vector<MergedPoint>& points,
                                             const std::vector<Eigen::Vector3d>& to_camera, double spacing,
                                             int threads);

}  // namespace frond
