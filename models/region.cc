// SPDX-License-Identifier: BSD-3-Clause
#include "models/region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "models/mesh_repair.h"
#include "models/parity_sets.h"

namespace frond {

bool IsInside(std::span<const HalfSpace> region, const Eigen::Vector3d& x) {
  return std::all_of(region.begin(), region.end(),
                     [&](const HalfSpace& half) { return half.normal.dot(x - half.point) >= 0; });
}

std::vector<Eigen::Vector3d> PointsInside(std::span<const HalfSpace> region,
                                          std::span<const Eigen::Vector3d> points) {
  std::vector<Eigen::Vector3d> inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&](const Eigen::Vector3d& point) { return IsInside(region, point); });
  return inside;
}

namespace {

constexpr int kCrumbShare = 100;

void DropCrumbs(SurfaceMesh* mesh) {
  ParitySets parts(mesh->vertices.size());
  for (const auto& [a, b, c] : mesh->triangles) {
    parts.Join(a, b);
    parts.Join(a, c);
  }
  const auto part_of = [&](const std::array<int, 3>& t) {
    return static_cast<std::size_t>(parts.Find(t[0]));
  };
  std::vector<int> faces(mesh->vertices.size(), 0);
  int most = 0;
  for (const auto& triangle : mesh->triangles) most = std::max(most, ++faces[part_of(triangle)]);
  std::erase_if(mesh->triangles, [&](const auto& t) { return kCrumbShare * faces[part_of(t)] < most; });
}

// What lies on the inner side, the faces that the plane crosses cut along it. Vertices nearer to the plane
// than kOnPlane of the mesh's size count as on it.
SurfaceMesh Cut(const HalfSpace& half, const SurfaceMesh& mesh) {
  constexpr double kOnPlane = 1e-9;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex);
  const Eigen::Vector3d normal = half.normal.normalized();
  const double on_plane = kOnPlane * box.sizes().norm();
  std::vector<double> height;
  height.reserve(mesh.vertices.size());
  for (const auto& vertex : mesh.vertices) {
    const double h = normal.dot(vertex - half.point);
    height.push_back(std::abs(h) <= on_plane ? 0 : h);
  }
  SurfaceMesh inside;
  inside.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> crossings;  // an edge's new vertex
  const auto crossing = [&](int a, int b) {
    const auto [place, is_new] =
        crossings.try_emplace(std::minmax(a, b), static_cast<int>(inside.vertices.size()));
    if (is_new) {
      const auto low = static_cast<std::size_t>(place->first.first),
                 high = static_cast<std::size_t>(place->first.second);
      const double t = height[low] / (height[low] - height[high]);
      inside.vertices.push_back((1 - t) * mesh.vertices[low] + t * mesh.vertices[high]);
    }
    return place->second;
  };
  for (const auto& triangle : mesh.triangles) {
    const auto at = [&](std::size_t k) { return height[static_cast<std::size_t>(triangle[k % 3])]; };
    if (std::max({at(0), at(1), at(2)}) <= 0) continue;
    std::vector<int> polygon;
    for (std::size_t k = 0; k < 3; ++k) {
      if (at(k) >= 0) polygon.push_back(triangle[k]);
      if (at(k) * at(k + 1) < 0) polygon.push_back(crossing(triangle[k], triangle[(k + 1) % 3]));
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      inside.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
  }
  return inside;
}

}  // namespace

SurfaceMesh MeshInside(std::span<const HalfSpace> region, const SurfaceMesh& mesh) {
  SurfaceMesh inside;
  inside.vertices = mesh.vertices;
  inside.triangles = mesh.triangles;
  for (const HalfSpace& half : region) inside = Cut(half, inside);
  if (!region.empty()) {
    SplitPinchedVertices(&inside);
    DropCrumbs(&inside);
  }
  return WithoutUnreferenced(inside);
}

}  // namespace frond
