// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// Triangles over a surface. `normals` are unit vectors along S_u × S_v (the mean of the incident triangles
// where that vanishes, as at a collapsed tip); `parameters` are (u, v) in the domain. All three are of one
// length. Triangles run counter-clockwise seen from the tip of the normals.
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<Eigen::Vector2d> parameters;
  std::vector<std::array<int, 3>> triangles;
};

// The surface inside its trim as a 2-manifold mesh with boundary: a grid of segments_per_span cells for each
// non-empty knot span and direction. Cells that a loop passes through are cut along it, every vertex of the
// loop being one of the mesh's; cells share the points on their common border. A domain edge that is one
// point in space is one vertex; periodic directions are closed. Each triangle has a positive area in (u, v).
// Loops must not cross themselves or each other; where they do, the mesh is of no use near the crossing.
// Throws InputError where a loop leaves the domain or segments_per_span < 1.
SurfaceMesh Tessellate(const TrimmedSurface& surface, int segments_per_span);

}  // namespace frond
