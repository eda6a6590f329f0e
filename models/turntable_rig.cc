// SPDX-License-Identifier: BSD-3-Clause
#include "models/turntable_rig.h"

#include <cmath>

namespace frond {

double TurntableRig::Tilt() const {
  const Eigen::Vector3d up = camera_from_disk.linear().col(2);
  return std::atan2(-up.z(), std::hypot(up.x(), up.y()));
}

double TurntableRig::Roll() const {
  const Eigen::Vector3d up = camera_from_disk.linear().col(2);
  return std::atan2(up.x(), -up.y());
}

Eigen::Isometry3d TurntableRig::CameraFromDisk(double angle) const {
  return camera_from_disk * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
}

StereoPair TurntableRig::Pair(double first_angle, double second_angle) const {
  return {.left = camera,
          .right = camera,
          .right_from_left = CameraFromDisk(second_angle) * CameraFromDisk(first_angle).inverse()};
}

TurntableRig RigFromAxis(const PinholeCamera& camera, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& direction) {
  Eigen::Vector3d up = direction.normalized();
  if (up.y() > 0) up = -up;
  const Eigen::Vector3d origin = point - point.dot(up) * up;
  TurntableRig rig;
  rig.camera = camera;
  rig.camera_from_disk.linear().col(0) = -origin.normalized();
  rig.camera_from_disk.linear().col(1) = up.cross(-origin.normalized());
  rig.camera_from_disk.linear().col(2) = up;
  rig.camera_from_disk.translation() = origin;
  return rig;
}

}  // namespace frond
