// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// The points x with n · (x − p) ≥ 0.
struct HalfSpace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // of any length above 0
};

// A region is what all its half-spaces have in common; all of space where there are none.
bool IsInside(std::span<const HalfSpace> region, const Eigen::Vector3d& x);

std::vector<Eigen::Vector3d> PointsInside(std::span<const HalfSpace> region,
                                          std::span<const Eigen::Vector3d> points);

// The part of a mesh inside, cut exactly along the planes, so that its rims are plane; new vertices come
// after those kept. Where the cut leaves faces that touch in a vertex alone, that vertex is split, and crumbs
// go: components with less than a hundredth of the faces of the largest. Normals and parameters are not kept.
SurfaceMesh MeshInside(std::span<const HalfSpace> region, const SurfaceMesh& mesh);

}  // namespace frond
