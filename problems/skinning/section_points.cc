// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "problems/skinning/local_quadric.h"

namespace frond {
namespace {

std::vector<Eigen::Vector3d> NearestPart(const std::vector<Eigen::Vector3d>& points,
                                         const Eigen::Vector3d& origin, double gap) {
  const KdTree tree(points);
  std::vector<int> part(points.size(), -1);
  std::vector<std::size_t> stack;
  std::array<KdTree::Neighbour, 64> found;
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t seed = 0; seed < points.size(); ++seed) {
    if (part[seed] >= 0) continue;
    const int number = static_cast<int>(seed);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    part[seed] = number;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const std::size_t i = stack.back();
      stack.pop_back();
      sum += points[i];
      count += 1;
      const std::size_t near = tree.Nearest(points[i], found, gap);
      for (std::size_t k = 0; k < near; ++k) {
        if (part[found[k].index] >= 0) continue;
        part[found[k].index] = number;
        stack.push_back(found[k].index);
      }
    }
    const double distance = (sum / count - origin).norm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = number;
  }
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (part[i] == best) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

std::vector<Eigen::Vector3d> SectionPoints(std::span<const Eigen::Vector3d> points, const KdTree& tree,
                                           const SectionPlane& plane, double tolerance, double gap) {
  std::vector<Eigen::Vector3d> section;
  for (const Eigen::Vector3d& point : points) {
    const double height = plane.Height(point);
    if (std::abs(height) > tolerance) continue;
    if (const auto quadric = FitLocalQuadric(points, tree, point)) {
      const auto moved = MoveToPlane(*quadric, plane.origin, plane.normal, tolerance);
      if (moved) section.push_back(moved->position);
    } else {
      section.push_back(point - height * plane.normal);
    }
  }
  return section.empty() ? section : NearestPart(section, plane.origin, gap);
}

Eigen::Vector3d SectionCentroid(std::span<const Eigen::Vector3d> section, const SectionPlane& plane) {
  std::vector<std::pair<double, std::size_t>> order;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : section) mean += point / static_cast<double>(section.size());
  SectionPlane about = plane;
  about.origin = mean;
  for (std::size_t i = 0; i < section.size(); ++i) order.emplace_back(about.Angle(section[i]), i);
  std::sort(order.begin(), order.end());
  double area = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Eigen::Vector3d a = section[order[k].second] - mean;
    const Eigen::Vector3d b = section[order[(k + 1) % order.size()].second] - mean;
    const double twice = a.cross(b).dot(plane.normal);
    area += twice / 2;
    sum += twice / 6 * (a + b);
  }
  return area > 0 ? Eigen::Vector3d(mean + sum / area) : mean;
}

}  // namespace frond
