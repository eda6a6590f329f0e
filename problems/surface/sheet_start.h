// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// Parameters in [0, 1]² from a sheet's frame coordinates (u along y, v along x).

// By the bounding rectangle of `extent`, with the share `margin` of the domain left free on each side.
std::vector<Eigen::Vector2d> RectangleParameters(std::span<const Eigen::Vector3d> points,
                                                 std::span<const Eigen::Vector3d> extent, double margin);

// By the outline: v as above, u from one side of the ring to the other at that x, so that the domain's edges
// lie on the ring. `ring`: a closed polygon in the x-y plane (z is not looked at).
std::vector<Eigen::Vector2d> OutlineParameters(std::span<const Eigen::Vector3d> points,
                                               const std::vector<Eigen::Vector3d>& ring);

// The points' feet on a surface, scaled to [0, 1]².
std::vector<Eigen::Vector2d> FootParameters(std::span<const Eigen::Vector3d> points,
                                            const NurbsSurface& surface, int threads);

}  // namespace frond
