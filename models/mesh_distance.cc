// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace frond {
namespace {

constexpr int kLeafSize = 4;

Eigen::Vector3d NearestOnSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                 const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  const double squared = d.squaredNorm();
  return squared > 0 ? Eigen::Vector3d(a + std::clamp((p - a).dot(d) / squared, 0.0, 1.0) * d) : a;
}

}  // namespace

Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const double squared = n.squaredNorm();
  if (squared > 0) {  // the foot in the plane, where it is inside
    const Eigen::Vector3d foot = p - n * (n.dot(p - a) / squared);
    const bool inside = (b - a).cross(foot - a).dot(n) >= 0 && (c - b).cross(foot - b).dot(n) >= 0 &&
                        (a - c).cross(foot - c).dot(n) >= 0;
    if (inside) return foot;
  }
  Eigen::Vector3d best = NearestOnSegment(p, a, b);
  for (const Eigen::Vector3d& q : {NearestOnSegment(p, b, c), NearestOnSegment(p, c, a)}) {
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

MeshDistance::MeshDistance(const SurfaceMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::Vector3d> centroids;
  centroids.reserve(order_.size());
  for (const auto& t : mesh.triangles) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int k : t) sum += mesh.vertices[static_cast<std::size_t>(k)] / 3;
    centroids.push_back(sum);
  }
  Build(0, static_cast<int>(order_.size()), centroids);
}

int MeshDistance::Build(int begin, int end, const std::vector<Eigen::Vector3d>& centroids) {
  const int number = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.begin = begin;
  node.end = end;
  for (int k = begin; k < end; ++k) {
    for (const int vertex : mesh_->triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]) {
      node.box.extend(mesh_->vertices[static_cast<std::size_t>(vertex)]);
    }
  }
  if (end - begin > kLeafSize) {
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const int middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) {
                       const double x = centroids[static_cast<std::size_t>(a)][axis],
                                    y = centroids[static_cast<std::size_t>(b)][axis];
                       return x < y || (x == y && a < b);
                     });
    node.left = Build(begin, middle, centroids);
    node.right = Build(middle, end, centroids);
  }
  nodes_[static_cast<std::size_t>(number)] = node;
  return number;
}

void MeshDistance::Search(int number, const Eigen::Vector3d& point, double* squared) const {
  const Node& node = nodes_[static_cast<std::size_t>(number)];
  if (node.left < 0) {
    for (int k = node.begin; k < node.end; ++k) {
      const auto& t = mesh_->triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
      const auto corner = [&](std::size_t i) { return mesh_->vertices[static_cast<std::size_t>(t[i])]; };
      *squared = std::min(*squared,
                          (NearestOnTriangle(point, corner(0), corner(1), corner(2)) - point).squaredNorm());
    }
    return;
  }
  int first = node.left, second = node.right;
  double near = nodes_[static_cast<std::size_t>(first)].box.squaredExteriorDistance(point);
  double far = nodes_[static_cast<std::size_t>(second)].box.squaredExteriorDistance(point);
  if (far < near) {
    std::swap(first, second);
    std::swap(near, far);
  }
  if (near < *squared) Search(first, point, squared);
  if (far < *squared) Search(second, point, squared);
}

double MeshDistance::operator()(const Eigen::Vector3d& point) const {
  double squared = std::numeric_limits<double>::infinity();
  Search(0, point, &squared);
  return std::sqrt(squared);
}

}  // namespace frond
