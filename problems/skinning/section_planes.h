// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace frond {

// Where a section is cut. `start` is a unit vector in the plane: the section's parameter begins in that
// direction from `origin` and runs counter-clockwise about `normal` (unit).
struct SectionPlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d start = Eigen::Vector3d::UnitX();

  double Height(const Eigen::Vector3d& point) const { return (point - origin).dot(normal); }
  double Angle(const Eigen::Vector3d& point) const;  // of the point's foot, from `start`, in [0, 2π)
};

// Turns normals over that point against the way from one origin to the next.
void OrientNormals(std::span<SectionPlane> planes);

// Starts of least twist: the frame that does not turn about the line through the origins, with the normals as
// its tangents, by double reflection (Wang, Jüttler, Zheng, Liu 2008). The first start is as near to `hint`
// as its plane allows.
void AlignStarts(const Eigen::Vector3d& hint, std::span<SectionPlane> planes);

}  // namespace frond
