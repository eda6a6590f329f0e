// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/contradicted_points.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/parallel.h"
#include "models/kd_tree.h"

namespace frond {

std::vector<std::uint8_t> ContradictedPoints(const std::vector<MergedPoint>& points,
                                             const std::vector<Eigen::Vector3d>& to_camera, double spacing,
                                             int threads) {
  constexpr int kLeastViews = 3;
  constexpr int kStepsBehind = 8;
  constexpr double kSameSurface = 1.5;  // spacings along the ray that are no contradiction
  std::vector<std::uint8_t> contradicted(points.size(), 0);
  std::vector<Eigen::Vector3d> sure;
  std::vector<std::size_t> number;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].views < kLeastViews) continue;
    sure.push_back(points[i].position);
    number.push_back(i);
    box.extend(points[i].position);
  }
  if (sure.empty()) return contradicted;
  const KdTree tree(sure);
  const auto steps_in_front = static_cast<int>(box.diagonal().norm() / spacing) + 1;
  ParallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (points[i].views != 1) continue;
      const Eigen::Vector3d& p = points[i].position;
      for (int step = -kStepsBehind; step <= steps_in_front && !contradicted[i]; ++step) {
        const Eigen::Vector3d query = p + step * spacing * to_camera[i];
        const KdTree::Neighbour nearest = tree.Nearest(query);
        if (nearest.squared_distance > spacing * spacing) continue;
        const MergedPoint& other = points[number[nearest.index]];
        const double along = (other.position - p).dot(to_camera[i]);
        const double away = 4 * std::hypot(other.sigma, points[i].sigma) + kSameSurface * spacing;
        if (other.normal.dot(to_camera[i]) > 0.3 && std::abs(along) > away) contradicted[i] = 1;
      }
    }
  });
  return contradicted;
}

}  // namespace frond
