// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/unseen_poles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/median.h"
#include "models/kd_tree.h"
#include "problems/turntable/end_quadric.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;
constexpr double kBand = 30 * std::numbers::pi / 180;
constexpr double kCovered = 3;  // spacings from the cloud within which the surface is seen

double AngleFrom(const Eigen::Vector3d& p, double end) {
  return std::atan2(std::hypot(p.y(), p.z()), end * p.x());
}

double SpacingOf(std::span<const Eigen::Vector3d> points, const KdTree& tree) {
  std::vector<double> distances;
  std::array<KdTree::Neighbour, 2> found;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 2000) {
    tree.Nearest(points[i], found);
    distances.push_back(std::sqrt(found[1].squared_distance));
  }
  return Median(std::move(distances));
}

// The angle within which the end has no points: of the nearest few, so that a stray does not hide the hole.
double InnerAngle(std::span<const Eigen::Vector3d> points, double end) {
  std::vector<double> angles;
  for (const Eigen::Vector3d& p : points) angles.push_back(AngleFrom(p, end));
  const std::size_t few = std::min(angles.size() - 1, angles.size() / 1000 + 3);
  std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(few), angles.end());
  return angles[few];
}

// The points about an end, between its hole and kBand beyond it.
struct Rim {
  double outer = 0;    // radians
  double radius = 0;   // from the axis, largest
  double highest = 0;  // along the axis
  Points points = {};
};

Rim RimOf(std::span<const Eigen::Vector3d> points, double end) {
  Rim rim{.outer = InnerAngle(points, end) + kBand};
  for (const Eigen::Vector3d& p : points) {
    if (AngleFrom(p, end) > rim.outer) continue;
    rim.points.push_back(p);
    rim.radius = std::max(rim.radius, std::hypot(p.y(), p.z()));
    rim.highest = std::max(rim.highest, end * p.x());
  }
  return rim;
}

// By silhouettes, which real images may bend at the foot (a shadow, the disk's edge): it has to meet the
// points next to the hole, within 1/50 of the rim's radius in median.
std::optional<EndQuadric> TouchingQuadric(std::span<const TangentPlane> planes, const Rim& rim, double end) {
  constexpr double kPlanesWithin = 0.64;  // cos 50°
  constexpr double kMostGap = 1.0 / 50;
  std::vector<TangentPlane> near;
  for (const TangentPlane& plane : planes) {
    if (end * plane.normal.x() > kPlanesWithin) near.push_back(plane);
  }
  std::optional<EndQuadric> quadric = QuadricTouching(near);
  if (!quadric) return std::nullopt;
  std::vector<double> gaps;
  for (const Eigen::Vector3d& p : rim.points) {
    if (AngleFrom(p, end) > rim.outer - 0.8 * kBand) continue;
    // First-order distance of the point.
    const double value = p.dot(quadric->a * p) + 2 * quadric->b.dot(p) + quadric->c;
    gaps.push_back(std::abs(value) / (2 * (quadric->a * p + quadric->b).norm()));
  }
  if (gaps.empty() || Median(std::move(gaps)) > kMostGap * rim.radius) return std::nullopt;
  return quadric;
}

// Where the cloud leaves the quadric's end open.
PoleCap CapOn(const EndQuadric& quadric, const Rim& rim, const KdTree& tree, double spacing, double end) {
  PoleCap cap;
  const auto steps = static_cast<int>(std::min(rim.radius / spacing, 500.0));
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      const double y = i * spacing, z = k * spacing;
      const std::optional<double> x = quadric.At(y, z, end);
      if (!x) continue;
      const Eigen::Vector3d p(*x, y, z);
      if (AngleFrom(p, end) > rim.outer) continue;
      if (tree.Nearest(p).squared_distance < kCovered * kCovered * spacing * spacing) continue;
      cap.points.push_back(p);
      cap.opening = std::max(cap.opening, AngleFrom(p, end));
      // A cap higher over its rim than that is wide is a guess too far.
      if (end * *x > rim.highest + rim.radius) cap.closable = false;
    }
  }
  if (!cap.closable) cap.points.clear();
  return cap;
}

}  // namespace

PoleCap CloseUnseenPole(std::span<const Eigen::Vector3d> points, std::span<const TangentPlane> planes,
                        double end) {
  if (points.size() < 10) return {.closable = false};
  const KdTree tree(points);
  const double spacing = SpacingOf(points, tree);
  if (!(spacing > 0)) return {.closable = false};
  const Rim rim = RimOf(points, end);
  if (const std::optional<EndQuadric> touching = TouchingQuadric(planes, rim, end)) {
    PoleCap cap = CapOn(*touching, rim, tree, spacing, end);
    cap.silhouettes = true;
    if (cap.closable) return cap;
  }
  const std::optional<EndQuadric> through = QuadricThrough(rim.points);
  return through ? CapOn(*through, rim, tree, spacing, end) : PoleCap{.closable = false};
}

}  // namespace frond
