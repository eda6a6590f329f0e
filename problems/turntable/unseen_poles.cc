// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/unseen_poles.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/median.h"
#include "models/kd_tree.h"

namespace frond {
namespace {

using Row = Eigen::Matrix<double, 9, 1>;
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

// F(x, y, z) of the header, in a unit in which the points are about 1 from the origin.
class Quadric {
 public:
  static std::optional<Quadric> Through(const Points& points) {
    constexpr std::size_t kLeast = 40;
    if (points.size() < kLeast) return std::nullopt;
    Quadric quadric;
    for (const Eigen::Vector3d& p : points) quadric.scale_ = std::max(quadric.scale_, p.norm());
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    Row right = Row::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d p = point / quadric.scale_;
      Row row;
      row << p.y() * p.y() - p.z() * p.z(), p.y() * p.z(), p.y(), p.z(), p.x(), p.x() * p.x(), p.x() * p.y(),
          p.x() * p.z(), 1;
      normal += row * row.transpose();
      right -= (p.y() * p.y() + p.z() * p.z()) * row;
    }
    quadric.c_ = normal.ldlt().solve(right);
    if (!quadric.c_.allFinite()) return std::nullopt;
    return quadric;
  }

  // x at (y, z) where the surface faces the end.
  std::optional<double> At(double y, double z, double end) const {
    y /= scale_;
    z /= scale_;
    const double square = c_[5], linear = c_[4] + c_[6] * y + c_[7] * z;
    const double rest =
        y * y + z * z + c_[0] * (y * y - z * z) + c_[1] * y * z + c_[2] * y + c_[3] * z + c_[8];
    const double root = linear * linear - 4 * square * rest;
    if (!(root > 0)) return std::nullopt;
    // There ∂F/∂x = 2 square x + linear = ±√root, outwards where it has the end's sign.
    const double slope = end * std::sqrt(root);
    if (std::abs(linear + slope) < 1e-12) return std::nullopt;
    // The same root as (slope − linear) / (2 square), also where the square term vanishes.
    return scale_ * -2 * rest / (linear + slope);
  }

 private:
  double scale_ = 0;
  Row c_ = Row::Zero();
};

}  // namespace

PoleCap CloseUnseenPole(std::span<const Eigen::Vector3d> points, double end) {
  PoleCap cap;
  if (points.size() < 10) return cap;
  const KdTree tree(points);
  const double spacing = SpacingOf(points, tree), inner = InnerAngle(points, end);
  Points band;
  double radius = 0, highest = 0;
  for (const Eigen::Vector3d& p : points) {
    if (AngleFrom(p, end) > inner + kBand) continue;
    band.push_back(p);
    radius = std::max(radius, std::hypot(p.y(), p.z()));
    highest = std::max(highest, end * p.x());
  }
  const std::optional<Quadric> quadric = Quadric::Through(band);
  if (!quadric || !(spacing > 0)) return {.closable = false};
  const auto steps = static_cast<int>(std::min(radius / spacing, 500.0));
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      const double y = i * spacing, z = k * spacing;
      const std::optional<double> x = quadric->At(y, z, end);
      if (!x) continue;
      const Eigen::Vector3d p(*x, y, z);
      if (AngleFrom(p, end) > inner + kBand) continue;
      if (tree.Nearest(p).squared_distance < kCovered * kCovered * spacing * spacing) continue;
      cap.points.push_back(p);
      cap.opening = std::max(cap.opening, AngleFrom(p, end));
      // A cap higher over its rim than that is wide is a guess too far.
      if (end * *x > highest + radius) cap.closable = false;
    }
  }
  if (!cap.closable) cap.points.clear();
  return cap;
}

}  // namespace frond
