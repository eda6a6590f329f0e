// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/closed_start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "base/errors.h"
#include "models/kd_tree.h"
#include "problems/surface/boundary_ring.h"
#include "problems/surface/principal_axes.h"

namespace frond {
namespace {

using Points = std::span<const Eigen::Vector3d>;
constexpr double kTurn = 2 * std::numbers::pi;

double ToUnit(double angle) {
  const double u = angle / kTurn;
  return u - std::floor(u);
}

// Shortest paths through the nearest neighbours of each point.
class NeighbourGraph {
 public:
  explicit NeighbourGraph(Points points) : points_(points), tree_(points), neighbours_(points.size()) {
    std::array<KdTree::Neighbour, kNeighbours + 1> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t n = tree_.Nearest(points[i], found);
      for (std::size_t k = 0; k < n; ++k) {
        if (found[k].index == i) continue;
        neighbours_[i].push_back(found[k].index);
        neighbours_[found[k].index].push_back(i);
      }
    }
  }

  // From each point to the nearest of `sources` along the cloud; infinite where no path leads there.
  std::vector<double> Distances(Points sources) const {
    std::vector<double> distance(points_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto reach = [&](std::size_t i, double d) {
      if (d >= distance[i]) return;
      distance[i] = d;
      queue.emplace(d, i);
    };
    for (const auto& source : sources) {
      const KdTree::Neighbour nearest = tree_.Nearest(source);
      reach(nearest.index, std::sqrt(nearest.squared_distance));
    }
    while (!queue.empty()) {
      const auto [d, i] = queue.top();
      queue.pop();
      if (d > distance[i]) continue;
      for (const std::size_t k : neighbours_[i]) reach(k, d + (points_[k] - points_[i]).norm());
    }
    return distance;
  }

 private:
  static constexpr std::size_t kNeighbours = 10;
  Points points_;
  KdTree tree_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

std::size_t Farthest(const std::vector<double>& distance) {
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const bool better = std::isfinite(distance[i]) &&
                        (!std::isfinite(distance[farthest]) || distance[i] > distance[farthest]);
    if (better) farthest = i;
  }
  return farthest;
}

// d₀ and d₁ of GeodesicParameters.
std::array<std::vector<double>, 2> DistancesToEnds(Points points, SurfaceTopology topology,
                                                   const std::vector<Ring>& rims) {
  const NeighbourGraph graph(points);
  if (topology == SurfaceTopology::kTube) return {graph.Distances(rims.at(0)), graph.Distances(rims.at(1))};
  std::vector<double> end;
  if (topology == SurfaceTopology::kCup) {
    end = graph.Distances(rims.at(0));
  } else {
    const std::size_t first = Farthest(graph.Distances(points.first(1)));
    end = graph.Distances(points.subspan(first, 1));
  }
  std::vector<double> begin = graph.Distances(points.subspan(Farthest(end), 1));
  return {std::move(begin), std::move(end)};
}

// The line through the middles of the levels of v, with a direction across it carried along without twist.
class CentreLine {
 public:
  CentreLine(Points points, const std::vector<double>& v, PoleEnds poles) {
    std::array<std::vector<std::size_t>, kLevels> level;
    for (std::size_t i = 0; i < points.size(); ++i) {
      level[std::min<std::size_t>(kLevels - 1, static_cast<std::size_t>(v[i] * kLevels))].push_back(i);
    }
    const auto pole = [&](bool last) {
      const auto at = last ? std::max_element(v.begin(), v.end()) : std::min_element(v.begin(), v.end());
      return points[static_cast<std::size_t>(at - v.begin())];
    };
    if (poles.begin) Add(0, pole(false));
    for (std::size_t k = 0; k < kLevels; ++k) {
      if (!level[k].empty()) Add((static_cast<double>(k) + 0.5) / kLevels, MiddleOf(points, level[k]));
    }
    if (poles.end) Add(1, pole(true));
    if (v_.size() < 2) throw FitError("the cloud has no length between its two ends");
    Eigen::Vector3d across = Tangent(0).unitOrthogonal();
    for (std::size_t k = 0; k < middle_.size(); ++k) {
      across = (across - across.dot(Tangent(k)) * Tangent(k)).normalized();
      across_.push_back(across);
    }
  }

  double Angle(const Eigen::Vector3d& point, double v) const {
    const auto [k, t] = SegmentOf(v);
    const Eigen::Vector3d tangent = (1 - t) * Tangent(k) + t * Tangent(k + 1);
    const Eigen::Vector3d across = (1 - t) * across_[k] + t * across_[k + 1];
    const Eigen::Vector3d d = point - Middle(v);
    return std::atan2(d.dot(tangent.cross(across)), d.dot(across));
  }

  Eigen::Vector3d Middle(double v) const {
    const auto [k, t] = SegmentOf(v);
    return (1 - t) * middle_[k] + t * middle_[k + 1];
  }

 private:
  static constexpr std::size_t kLevels = 16;

  std::pair<std::size_t, double> SegmentOf(double v) const {
    std::size_t k = 0;
    while (k + 2 < v_.size() && v_[k + 1] < v) ++k;
    return {k, std::clamp((v - v_[k]) / (v_[k + 1] - v_[k]), 0.0, 1.0)};
  }

  void Add(double v, const Eigen::Vector3d& middle) {
    v_.push_back(v);
    middle_.push_back(middle);
  }

  // The mean of the means of twelve sectors, so that uneven sampling does not pull it aside.
  static Eigen::Vector3d MiddleOf(Points points, const std::vector<std::size_t>& members) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t i : members) mean += points[i] / static_cast<double>(members.size());
    std::vector<Eigen::Vector3d> some;
    for (const std::size_t i : members) some.push_back(points[i]);
    if (some.size() < 24) return mean;
    const Eigen::Matrix3d axes = FindPrincipalAxes(some, std::vector<std::uint8_t>(some.size(), 0)).axes;
    constexpr std::size_t kSectors = 12;
    std::array<Eigen::Vector3d, kSectors> sum;
    sum.fill(Eigen::Vector3d::Zero());
    std::array<int, kSectors> count{};
    for (const auto& point : some) {
      const Eigen::Vector3d d = axes.transpose() * (point - mean);
      const auto sector =
          std::min(kSectors - 1, static_cast<std::size_t>(ToUnit(std::atan2(d.y(), d.x())) * kSectors));
      sum[sector] += point;
      ++count[sector];
    }
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    int sectors = 0;
    for (std::size_t s = 0; s < kSectors; ++s) {
      if (count[s] == 0) continue;
      middle += sum[s] / count[s];
      ++sectors;
    }
    return middle / sectors;
  }

  Eigen::Vector3d Tangent(std::size_t k) const {
    const std::size_t a = k > 0 ? k - 1 : 0, b = std::min(k + 1, middle_.size() - 1);
    const Eigen::Vector3d d = middle_[b] - middle_[a];
    return d.squaredNorm() > 0 ? Eigen::Vector3d(d.normalized()) : Eigen::Vector3d::UnitX();
  }

  std::vector<double> v_;
  std::vector<Eigen::Vector3d> middle_, across_;
};

// v = d₀ / (d₀ + d₁); points that no path joins to the ends stay half-way.
std::vector<double> Levels(const std::array<std::vector<double>, 2>& ends) {
  std::vector<double> v(ends[0].size(), 0.5);
  std::size_t reached = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double length = ends[0][i] + ends[1][i];
    if (!std::isfinite(length)) continue;
    ++reached;
    if (length > 0) v[i] = ends[0][i] / length;
  }
  constexpr double kReached = 0.95;
  if (static_cast<double>(reached) < kReached * static_cast<double>(v.size())) {
    throw FitError(
        "the cloud falls apart: no path along it joins its points to its ends; of a coarse mesh set "
        "input.samples, else fit.base to cylinder or sphere");
  }
  return v;
}

// Of the points nearer than `band` to an end, in polar coordinates: the angle round the line and the distance
// from the other end, less what all have in common beyond `radius`.
Ring RimAt(Points points, std::span<const double> to_end, std::span<const double> to_other,
           std::span<const double> v, const CentreLine& line, double radius, double spacing) {
  const double band = std::max(8 * spacing, 0.5 * radius);
  std::vector<std::size_t> members;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(to_end[i] < band && std::isfinite(to_other[i]))) continue;
    members.push_back(i);
    least = std::min(least, to_other[i]);
  }
  std::vector<Eigen::Vector2d> plane;
  for (const std::size_t i : members) {
    const double r = radius + to_other[i] - least, angle = line.Angle(points[i], v[i]);
    plane.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  Ring ring;
  for (const auto i : BoundaryRing(plane, 8 * spacing)) ring.push_back(points[members[i]]);
  return ring;
}

}  // namespace

std::vector<Eigen::Vector2d> SphericalParameters(Points points) {
  std::vector<Eigen::Vector2d> parameters;
  parameters.reserve(points.size());
  for (const auto& p : points) {
    parameters.emplace_back(ToUnit(std::atan2(p.z(), p.y())),
                            std::atan2(std::hypot(p.y(), p.z()), -p.x()) / std::numbers::pi);
  }
  return parameters;
}

bool IsStarShaped(Points points) {
  constexpr std::size_t kRound = 36, kAlong = 18;
  constexpr double kSpread = 1.0 / 3, kShare = 0.02;
  std::array<std::array<double, 2>, kRound * kAlong> radii;  // least and largest in each direction
  radii.fill({std::numeric_limits<double>::infinity(), 0});
  const std::vector<Eigen::Vector2d> angles = SphericalParameters(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto round = std::min(kRound - 1, static_cast<std::size_t>(angles[i][0] * kRound));
    const auto along = std::min(kAlong - 1, static_cast<std::size_t>(angles[i][1] * kAlong));
    auto& [least, largest] = radii[round * kAlong + along];
    least = std::min(least, points[i].norm());
    largest = std::max(largest, points[i].norm());
  }
  double seen = 0, spread = 0;
  for (const auto& [least, largest] : radii) {
    if (!(largest > 0)) continue;
    ++seen;
    if (largest - least > kSpread * largest) ++spread;
  }
  return spread <= kShare * seen;
}

std::vector<Eigen::Vector2d> CylinderParameters(Points points) {
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const auto& p : points) {
    begin = std::min(begin, p.x());
    end = std::max(end, p.x());
  }
  std::vector<Eigen::Vector2d> parameters;
  parameters.reserve(points.size());
  for (const auto& p : points) {
    parameters.emplace_back(ToUnit(std::atan2(p.z(), p.y())),
                            end > begin ? (p.x() - begin) / (end - begin) : 0.5);
  }
  return parameters;
}

std::vector<Eigen::Vector2d> GeodesicParameters(Points points, SurfaceTopology topology,
                                                const std::vector<Ring>& rims) {
  const std::vector<double> v = Levels(DistancesToEnds(points, topology, rims));
  const CentreLine line(points, v, PolesOf(topology));
  std::vector<Eigen::Vector2d> parameters;
  parameters.reserve(points.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    parameters.emplace_back(ToUnit(line.Angle(points[i], v[i])), v[i]);
  return parameters;
}

std::vector<Ring> FindRims(Points points, SurfaceTopology topology, const std::vector<Ring>& guess,
                           double spacing) {
  if (topology == SurfaceTopology::kSphere) return {};
  const auto ends = DistancesToEnds(points, topology, guess);
  const std::vector<double> v = Levels(ends);
  const CentreLine line(points, v, PolesOf(topology));
  double radius = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    radius += (points[i] - line.Middle(v[i])).norm() / static_cast<double>(v.size());
  }
  std::vector<Ring> rims;
  if (topology == SurfaceTopology::kTube) {
    rims.push_back(RimAt(points, ends[0], ends[1], v, line, radius, spacing));
  }
  rims.push_back(RimAt(points, ends[1], ends[0], v, line, radius, spacing));
  return rims;
}

}  // namespace frond
