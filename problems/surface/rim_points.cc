// SPDX-License-Identifier: BSD-3-Clause
// GuessRims.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/errors.h"
#include "models/kd_tree.h"
#include "models/parity_sets.h"
#include "problems/surface/closed_start.h"
#include "problems/surface/principal_axes.h"

namespace frond {
namespace {

using Points = std::span<const Eigen::Vector3d>;

// Whether the nearest neighbours, seen in the plane fitted to them, leave a gap of more than a third of a
// turn.
bool OnBoundary(Points points, std::size_t i, const KdTree& tree) {
  constexpr std::size_t kNeighbours = 40;
  constexpr double kGap = 2 * std::numbers::pi / 3;
  std::array<KdTree::Neighbour, kNeighbours + 1> found;
  const std::size_t n = tree.Nearest(points[i], found);
  std::vector<Eigen::Vector3d> near;
  for (std::size_t k = 0; k < n; ++k) near.push_back(points[found[k].index]);
  const PrincipalAxes plane = FindPrincipalAxes(near, std::vector<std::uint8_t>(n, 0));
  std::vector<double> angles;
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector3d d = plane.axes.transpose() * (near[k] - points[i]);
    if (found[k].index != i) angles.push_back(std::atan2(d.y(), d.x()));
  }
  if (angles.empty()) return false;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
  return gap > kGap;
}

// Parts of the points that hang together over at most `reach`.
std::vector<Ring> PartsOf(const Ring& points, double reach) {
  const KdTree tree(points);
  ParitySets sets(points.size());
  std::array<KdTree::Neighbour, 64> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t n = tree.Nearest(points[i], found, reach);
    for (std::size_t k = 0; k < n; ++k) sets.Join(static_cast<int>(i), static_cast<int>(found[k].index));
  }
  std::map<int, Ring> parts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    parts[sets.Find(static_cast<int>(i))].push_back(points[i]);
  }
  std::vector<Ring> rings;
  for (auto& [root, part] : parts) rings.push_back(std::move(part));
  return rings;
}

double Extent(const Ring& ring) {
  Eigen::AlignedBox3d box;
  for (const auto& point : ring) box.extend(point);
  return box.diagonal().norm();
}

Eigen::Vector3d MeanOf(const Ring& ring) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : ring) mean += point / static_cast<double>(ring.size());
  return mean;
}

}  // namespace

std::vector<Ring> GuessRims(Points points, SurfaceTopology topology, double spacing) {
  if (topology == SurfaceTopology::kSphere) return {};
  const KdTree tree(points);
  Ring boundary;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (OnBoundary(points, i, tree)) boundary.push_back(points[i]);
  }
  std::vector<Ring> rims = boundary.empty() ? std::vector<Ring>() : PartsOf(boundary, 8 * spacing);
  std::stable_sort(rims.begin(), rims.end(),
                   [](const Ring& a, const Ring& b) { return Extent(a) > Extent(b); });
  const std::size_t wanted = topology == SurfaceTopology::kTube ? 2 : 1;
  if (rims.size() < wanted) {
    throw FitError("the cloud shows " + std::to_string(rims.size()) + " rims where " +
                   (wanted == 2 ? "a tube has 2" : "a cup has 1") +
                   ": set problem.topology, or fit a mesh as input.mesh");
  }
  rims.resize(wanted);
  const Eigen::Vector3d axis =
      FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0)).axes.col(0);
  if (wanted == 2 && axis.dot(MeanOf(rims[1]) - MeanOf(rims[0])) < 0) rims[0].swap(rims[1]);
  return rims;
}

}  // namespace frond
