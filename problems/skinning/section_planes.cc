// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_planes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

// x mirrored in the plane across `v` (not unit).
Eigen::Vector3d Reflected(const Eigen::Vector3d& x, const Eigen::Vector3d& v) {
  const double squared = v.squaredNorm();
  return squared > 0 ? Eigen::Vector3d(x - 2 * v.dot(x) / squared * v) : x;
}

Eigen::Vector3d InPlane(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along = direction - direction.dot(normal) * normal;
  if (along.norm() > 1e-6 * direction.norm()) return along.normalized();
  return normal.unitOrthogonal();
}

}  // namespace

double SectionPlane::Angle(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d d = point - origin;
  const double angle = std::atan2(d.dot(normal.cross(start)), d.dot(start));
  return angle < 0 ? std::min(angle + 2 * std::numbers::pi, std::nextafter(2 * std::numbers::pi, 0.0))
                   : angle;
}

void OrientNormals(std::span<SectionPlane> planes) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const std::size_t next = std::min(k + 1, planes.size() - 1), last = k == 0 ? 0 : k - 1;
    if (planes[k].normal.dot(planes[next].origin - planes[last].origin) < 0) planes[k].normal *= -1;
  }
}

void AlignStarts(const Eigen::Vector3d& hint, std::span<SectionPlane> planes) {
  if (planes.empty()) return;
  planes[0].start = InPlane(hint, planes[0].normal);
  for (std::size_t k = 1; k < planes.size(); ++k) {
    const Eigen::Vector3d across = planes[k].origin - planes[k - 1].origin;
    const Eigen::Vector3d start = Reflected(planes[k - 1].start, across);
    const Eigen::Vector3d normal = Reflected(planes[k - 1].normal, across);
    planes[k].start = InPlane(Reflected(start, planes[k].normal - normal), planes[k].normal);
  }
}

}  // namespace frond
