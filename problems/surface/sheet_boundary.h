// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// Where a scanned sheet ends, as BoundaryRing finds it with triangles of at most 5 spacings' circumradius.
// Points and feet in spatial order: large clouds are thinned to 100,000.

// The closed polygon through the boundary points seen along z; empty if there is none.
std::vector<Eigen::Vector3d> BoundaryOfSheet(const std::vector<Eigen::Vector3d>& points, double spacing);

// The boundary loop of the feet in (u, v), scaled to lengths so that curled sheets keep their proportions.
TrimLoop BoundaryOfFeet(const std::vector<Eigen::Vector2d>& feet, const NurbsSurface& surface,
                        double spacing);

}  // namespace frond
