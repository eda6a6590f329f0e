// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/errors.h"
#include "base/median.h"
#include "models/kd_tree.h"

namespace frond {
namespace {

constexpr std::size_t kMostCells = 1500;
constexpr std::size_t kLeastCells = 12;
constexpr double kGrowth = 1.25;      // of the cells, from trial to trial
constexpr double kChainShare = 0.95;  // of the cells on the tree's longest path
constexpr double kGap = 3;            // of a closed chain's ends, in median steps

using Points = std::vector<Eigen::Vector3d>;

// Averages of the points in each occupied cube, in the order of the cubes.
Points CellAverages(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& corner, double size) {
  struct Sum {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
  };
  std::map<std::array<long, 3>, Sum> cells;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d place = (point - corner) / size;
    Sum& cell = cells[{std::lround(place.x()), std::lround(place.y()), std::lround(place.z())}];
    cell.sum += point;
    ++cell.count;
  }
  Points averages;
  for (const auto& [place, cell] : cells) averages.emplace_back(cell.sum / cell.count);
  return averages;
}

// Prim's minimum spanning tree, as each vertex's neighbours.
std::vector<std::vector<std::size_t>> SpanningTree(const Points& points) {
  const std::size_t n = points.size();
  std::vector<std::vector<std::size_t>> tree(n);
  std::vector<double> distance(n, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> parent(n, 0);
  std::vector<bool> done(n, false);
  std::size_t last = 0;
  for (std::size_t round = 1; round < n; ++round) {
    done[last] = true;
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i]) continue;
      const double squared = (points[i] - points[last]).squaredNorm();
      if (squared < distance[i]) {
        distance[i] = squared;
        parent[i] = last;
      }
      if (next == n || distance[i] < distance[next]) next = i;
    }
    tree[next].push_back(parent[next]);
    tree[parent[next]].push_back(next);
    last = next;
  }
  return tree;
}

// The way from `from` to the vertex farthest along the tree, by length.
std::vector<std::size_t> FarthestPath(const std::vector<std::vector<std::size_t>>& tree, const Points& points,
                                      std::size_t from) {
  std::vector<std::size_t> parent(tree.size(), from), stack = {from};
  std::vector<double> length(tree.size(), 0);
  std::size_t farthest = from;
  while (!stack.empty()) {
    const std::size_t vertex = stack.back();
    stack.pop_back();
    if (length[vertex] > length[farthest]) farthest = vertex;
    for (const std::size_t next : tree[vertex]) {
      if (next == parent[vertex]) continue;
      parent[next] = vertex;
      length[next] = length[vertex] + (points[next] - points[vertex]).norm();
      stack.push_back(next);
    }
  }
  std::vector<std::size_t> path = {farthest};
  while (path.back() != from) path.push_back(parent[path.back()]);
  return path;
}

// From the end whose coordinates are less, so that the points' order has no say.
void Orient(Points* chain) {
  const Eigen::Vector3d &a = chain->front(), &b = chain->back();
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) {
    std::reverse(chain->begin(), chain->end());
  }
}

double MedianSpacing(std::span<const Eigen::Vector3d> points) {
  const KdTree tree(points);
  const std::size_t stride = points.size() / 2000 + 1;
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    std::array<KdTree::Neighbour, 3> near;
    const std::size_t found = tree.Nearest(points[i], near);
    spacings.push_back(std::sqrt(near[found - 1].squared_distance));
  }
  return Median(std::move(spacings));
}

// Whether a stretch between gaps of the chain closes in itself: a gap in one curve leaves open stretches.
bool HasClosedPart(const Points& chain) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < chain.size(); ++k) steps.push_back((chain[k] - chain[k - 1]).norm());
  const double gap = kGap * Median(steps);
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= chain.size(); ++k) {
    if (k < chain.size() && steps[k - 1] <= gap) continue;
    const bool part = k - begin < chain.size() && k - begin >= 6;
    if (part && (chain[k - 1] - chain[begin]).norm() <= gap) return true;
    begin = k;
  }
  return false;
}

}  // namespace

bool LooksClosed(std::span<const Eigen::Vector3d> points, double gap) {
  if (points.size() < 4) return false;
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i) steps.push_back((points[i] - points[i - 1]).norm());
  return (points.back() - points.front()).norm() <= gap * Median(std::move(steps));
}

PointChain FindChain(std::span<const Eigen::Vector3d> points, std::optional<bool> closed) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  const double extent = points.empty() ? 0 : box.diagonal().norm();
  if (!(extent > 0)) throw InputError("all points coincide: there is no curve to find");
  Points chain;
  bool whole = false;
  for (double size = std::max(MedianSpacing(points), 1e-4 * extent); size < extent; size *= kGrowth) {
    const Points averages = CellAverages(points, box.min(), size);
    if (averages.size() > kMostCells) continue;
    if (averages.size() < 2 || (averages.size() < kLeastCells && !chain.empty())) break;
    const auto tree = SpanningTree(averages);
    const std::vector<std::size_t> path =
        FarthestPath(tree, averages, FarthestPath(tree, averages, 0).front());
    chain.clear();
    for (const std::size_t vertex : path) chain.push_back(averages[vertex]);
    const auto cells = static_cast<double>(averages.size());
    whole = static_cast<double>(path.size()) >= std::min(kChainShare * cells, cells - 1);
    if (whole) break;
  }
  if (!chain.empty() && (!whole || HasClosedPart(chain))) {
    throw InputError(
        "the points are in parts or branch: no one curve passes by them all; take them apart, or give them "
        "in order ('curve.order: given')");
  }
  if (chain.size() < 2) chain = {box.min(), box.max()};
  Orient(&chain);
  return {chain, closed.value_or(LooksClosed(chain, kGap))};
}

std::vector<double> ProjectOnChain(std::span<const Eigen::Vector3d> points, const PointChain& chain) {
  const std::size_t n = chain.vertices.size(), segments = chain.closed ? n : n - 1;
  std::vector<double> at = {0};
  for (std::size_t k = 0; k < segments; ++k) {
    at.push_back(at.back() + (chain.vertices[(k + 1) % n] - chain.vertices[k]).norm());
  }
  std::vector<double> parameters;
  for (const Eigen::Vector3d& point : points) {
    double best = std::numeric_limits<double>::infinity(), place = 0;
    for (std::size_t k = 0; k < segments; ++k) {
      const Eigen::Vector3d& begin = chain.vertices[k];
      const Eigen::Vector3d along = chain.vertices[(k + 1) % n] - begin;
      const double squared_length = along.squaredNorm();
      if (!(squared_length > 0)) continue;
      const double share = std::clamp((point - begin).dot(along) / squared_length, 0.0, 1.0);
      const double squared = (begin + share * along - point).squaredNorm();
      if (squared >= best) continue;
      best = squared;
      place = at[k] + share * (at[k + 1] - at[k]);
    }
    place /= at.back();
    parameters.push_back(chain.closed && place >= 1 ? 0 : place);
  }
  return parameters;
}

}  // namespace frond
