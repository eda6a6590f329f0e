// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "problems/turntable/pose_refinement.h"

namespace frond {

// A point of one view, and the nearest of another with its plane.
struct PlaneRow {
  Eigen::Vector3d point, foot, normal;
  double sigma = 1;  // of the distance along the normal
};

struct OverlapPair {
  std::size_t first = 0, second = 0;  // views of the points and of the planes
  std::vector<PlaneRow> rows;
};

// Every two views (both ways) that see the same surface, with up to options.points_per_overlap rows each;
// `motion`: by view, applied to its points first.
std::vector<OverlapPair> FindOverlaps(const std::vector<std::vector<ScanPoint>>& views,
                                      const std::vector<Eigen::Isometry3d>& motion,
                                      const PoseRefinementOptions& options, int threads);

OverlapErrors ErrorsOfOverlaps(const std::vector<OverlapPair>& overlaps);

}  // namespace frond
