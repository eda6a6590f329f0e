// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/silhouette_planes.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.h"

namespace frond {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr int kReach = 8;  // columns to each side of the one that the parabola is for
constexpr int kEvery = 2;  // columns
constexpr double kSteepest = 1.7;

// By column: y of the edge above the object's first pixel or below its last; none where the column has no
// object or the object leaves the image.
std::vector<std::optional<double>> EdgeOf(const Mask& mask, bool top) {
  std::vector<std::optional<double>> edge(static_cast<std::size_t>(mask.width));
  for (int x = 0; x < mask.width; ++x) {
    int y = top ? 0 : mask.height - 1;
    while (mask.Contains(x, y) && mask(x, y) == 0) y += top ? 1 : -1;
    if (y > 0 && y + 1 < mask.height) edge[static_cast<std::size_t>(x)] = y + (top ? -0.5 : 0.5);
  }
  return edge;
}

struct EdgePoint {
  double y = 0, slope = 0;
};

std::optional<EdgePoint> SmoothedAt(const std::vector<std::optional<double>>& edge, int x) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int k = -kReach; k <= kReach; ++k) {
    const std::optional<double>& y = edge[static_cast<std::size_t>(x + k)];
    if (!y) return std::nullopt;
    const Eigen::Vector3d row(1, k, k * k);
    normal += row * row.transpose();
    right += *y * row;
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  if (std::abs(c[1]) > kSteepest) return std::nullopt;
  return EdgePoint{c[0], c[1]};
}

void AddPlanes(const TurntableView& view, const TurntableRig& rig, bool top,
               std::vector<TangentPlane>* planes) {
  const Eigen::Isometry3d disk_from_camera = rig.CameraFromDisk(view.angle * kRadians).inverse();
  const std::vector<std::optional<double>> edge = EdgeOf(view.mask, top);
  for (int x = kReach; x + kReach < view.mask.width; x += kEvery) {
    const std::optional<EdgePoint> point = SmoothedAt(edge, x);
    if (!point) continue;
    const Eigen::Vector3d along = rig.camera.Ray({x + 1.0, point->y + point->slope}) -
                                  rig.camera.Ray({x - 1.0, point->y - point->slope});
    Eigen::Vector3d normal = along.cross(rig.camera.Ray({double(x), point->y})).normalized();
    if ((normal.y() > 0) == top) normal = -normal;  // the image's y axis runs down
    const Eigen::Vector3d out = disk_from_camera.linear() * normal;
    planes->push_back({out, out.dot(disk_from_camera.translation())});
  }
}

}  // namespace

std::vector<TangentPlane> PlanesOfSilhouettes(std::span<const TurntableView> views, const TurntableRig& rig,
                                              int threads) {
  std::vector<std::vector<TangentPlane>> found(views.size());
  ParallelFor(views.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      AddPlanes(views[v], rig, true, &found[v]);
      AddPlanes(views[v], rig, false, &found[v]);
    }
  });
  std::vector<TangentPlane> planes;
  for (const auto& of_view : found) planes.insert(planes.end(), of_view.begin(), of_view.end());
  return planes;
}

}  // namespace frond
