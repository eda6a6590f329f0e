// SPDX-License-Identifier: BSD-3-Clause
#include "self_intersection.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

namespace frond {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

// Möller and Trumbore, for a segment.
bool Pierces(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Corners& t) {
  const Eigen::Vector3d way = to - from, e1 = t[1] - t[0], e2 = t[2] - t[0], h = way.cross(e2);
  const double det = e1.dot(h);
  if (std::abs(det) < 1e-14 * way.norm() * e1.norm() * e2.norm()) return false;
  const Eigen::Vector3d s = from - t[0], q = s.cross(e1);
  const double u = s.dot(h) / det, v = way.dot(q) / det, along = e2.dot(q) / det;
  return u > 0 && v > 0 && u + v < 1 && along > 0 && along < 1;
}

bool Cut(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (Pierces(a[k], a[(k + 1) % 3], b) || Pierces(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

}  // namespace

int CountSelfIntersections(const SurfaceMesh& mesh) {
  const auto corners = [&](std::size_t t) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
    }
    return c;
  };
  double cell = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners c = corners(t);
    for (std::size_t k = 0; k < 3; ++k) cell = std::max(cell, (c[k] - c[(k + 1) % 3]).norm());
  }
  std::map<std::array<int, 3>, std::vector<std::size_t>> grid;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners c = corners(t);
    const Eigen::Vector3d low = c[0].cwiseMin(c[1]).cwiseMin(c[2]) / cell;
    const Eigen::Vector3d high = c[0].cwiseMax(c[1]).cwiseMax(c[2]) / cell;
    for (int x = static_cast<int>(std::floor(low.x())); x <= high.x(); ++x) {
      for (int y = static_cast<int>(std::floor(low.y())); y <= high.y(); ++y) {
        for (int z = static_cast<int>(std::floor(low.z())); z <= high.z(); ++z) {
          auto& here = grid[{x, y, z}];
          for (const std::size_t other : here) pairs.emplace(other, t);
          here.push_back(t);
        }
      }
    }
  }
  int count = 0;
  for (const auto& [a, b] : pairs) {
    bool joined = false;
    for (const int i : mesh.triangles[a]) {
      for (const int j : mesh.triangles[b]) joined = joined || i == j;
    }
    if (!joined && Cut(corners(a), corners(b))) ++count;
  }
  return count;
}

}  // namespace frond
