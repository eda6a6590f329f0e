// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turntable_scene.h"

#include <cmath>
#include <numbers>

namespace frond {

Eigen::Vector3d Lighting::ToLamp() const {
  constexpr double kDegree = std::numbers::pi / 180;
  const double left = lamp_left * kDegree, up = lamp_up * kDegree;
  return {-std::sin(left) * std::cos(up), -std::sin(up), -std::cos(left) * std::cos(up)};
}

std::optional<Eigen::Vector3d> CastRay(const TurntableScene& scene, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction) {
  const auto t = scene.pear.CastRay(origin - scene.pear_origin, direction);
  if (!t) return std::nullopt;
  return origin + *t * direction;
}

double DistanceToPear(const TurntableScene& scene, const Eigen::Vector3d& point) {
  return scene.pear.SignedDistance(point - scene.pear_origin);
}

std::optional<TrueMatch> FindTrueMatch(const TurntableScene& scene, const Rectification& normal,
                                       double left_angle, double right_angle, double x, double y) {
  // A point this near to the first hit of the ray from the right camera is that hit; in shares of the ray.
  constexpr double kSamePoint = 1e-7;
  const Eigen::Isometry3d left_from_disk = scene.rig.CameraFromDisk(left_angle);
  const Eigen::Isometry3d disk_from_left = left_from_disk.inverse();
  const Eigen::Vector3d left = disk_from_left.translation();
  const Eigen::Vector3d right = scene.rig.CameraFromDisk(right_angle).inverse().translation();
  const Eigen::Vector3d direction =
      disk_from_left.linear() * normal.rotation[0].transpose() *
      Eigen::Vector3d((x - normal.cx[0]) / normal.f, (y - normal.cy) / normal.f, 1);
  const auto point = CastRay(scene, left, direction);
  if (!point) return std::nullopt;

  TrueMatch match;
  match.point = *point;
  match.normal = scene.pear.Normal(*point - scene.pear_origin);
  match.disparity = normal.Project(left_from_disk * *point).z();
  match.left_cosine = match.normal.dot((left - *point).normalized());
  match.right_cosine = match.normal.dot((right - *point).normalized());
  const auto t = scene.pear.CastRay(right - scene.pear_origin, *point - right);
  const double x_right = x - match.disparity;
  match.seen = match.right_cosine > 0 && t && *t > 1 - kSamePoint && x_right >= 0 &&
               x_right <= normal.width - 1 && y >= 0 && y <= normal.height - 1;
  return match;
}

}  // namespace frond
