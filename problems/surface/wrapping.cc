// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/wrapping.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/kd_tree.h"
#include "problems/surface/voxel_grid.h"
#include "problems/surface/voxel_topology.h"

namespace frond {
namespace {

Eigen::Matrix3d AxesOf(const Eigen::Matrix3d& moments) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors();
}

Eigen::Matrix3d Covariance(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& point : points) sum += (point - mean) * (point - mean).transpose();
  return sum;
}

// Of some points, by the plane through the nearest ones; signs as they come.
std::vector<Eigen::Vector3d> UnsignedNormals(std::span<const Eigen::Vector3d> points) {
  const KdTree tree(points);
  std::vector<Eigen::Vector3d> normals;
  std::array<KdTree::Neighbour, 12> neighbours;
  std::vector<Eigen::Vector3d> near;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 2000);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const std::size_t found = tree.Nearest(points[i], neighbours);
    near.clear();
    for (std::size_t k = 0; k < found; ++k) near.push_back(points[neighbours[k].index]);
    normals.push_back(AxesOf(Covariance(near)).col(0));
  }
  return normals;
}

// Whether the points, seen along the axis, enclose a hole: as a layer of balls their b₁ is above 0.
bool EnclosesHole(std::span<const Eigen::Vector3d> flat, double resolution) {
  VoxelSet voxels = UnionOfBalls(flat, resolution);
  return FindBettiNumbers(&voxels, 0).loops > 0;
}

double RingShare(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& axis, double resolution) {
  const Eigen::Vector3d across = axis.unitOrthogonal(), third = axis.cross(across);
  std::vector<std::pair<double, Eigen::Vector3d>> places;  // along the axis, and in the plane
  for (const auto& point : points) {
    places.emplace_back(axis.dot(point), Eigen::Vector3d(across.dot(point), third.dot(point), 0));
  }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t in_rings = 0;
  std::vector<Eigen::Vector3d> slab;
  for (std::size_t i = 0; i < places.size();) {
    const double end = places[i].first + 2 * resolution;
    slab.clear();
    for (; i < places.size() && places[i].first <= end; ++i) slab.push_back(places[i].second);
    if (EnclosesHole(slab, resolution)) in_rings += slab.size();
  }
  return static_cast<double>(in_rings) / static_cast<double>(points.size());
}

double EvennessAcross(const Eigen::Matrix3d& moments, const Eigen::Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis.unitOrthogonal();
  across.col(1) = axis.cross(across.col(0));
  const Eigen::Matrix2d flat = across.transpose() * moments * across;
  const Eigen::Vector2d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(flat).eigenvalues();
  return principal[1] > 0 ? principal[0] / principal[1] : 0;
}

}  // namespace

Wrapping FindWrapping(std::span<const Eigen::Vector3d> points, double resolution) {
  // Thinned, so that each point stands for about the same area.
  const std::vector<Eigen::Vector3d> even = VoxelGridMeans(points, 0.7 * resolution, Eigen::Vector3d::Zero());
  const std::vector<Eigen::Vector3d> normals = UnsignedNormals(even);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& normal : normals) moments += normal * normal.transpose();
  Wrapping best;
  best.ring_share = -1;
  for (const Eigen::Matrix3d& axes : {AxesOf(moments), AxesOf(Covariance(even))}) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      Wrapping wrapping;
      wrapping.axis = axes.col(k);
      double sum = 0;
      for (const auto& normal : normals) sum += std::abs(normal.dot(wrapping.axis));
      wrapping.projected = sum / static_cast<double>(normals.size());
      wrapping.evenness = EvennessAcross(moments, wrapping.axis);
      wrapping.ring_share = RingShare(even, wrapping.axis, resolution);
      if (wrapping.ring_share - wrapping.projected > best.ring_share - best.projected) best = wrapping;
    }
  }
  return best;
}

}  // namespace frond
