// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// The boundary of a plane cloud with spacing h: the Delaunay triangulation without the triangles whose
// circumradius exceeds `radius` (4h takes 0.35 % off the area, MATH.md §1), of whose boundary loops the one
// around the largest area is kept. Returns indices into `points`, counter-clockwise, a simple polygon; empty
// if no triangle is left. Uses Boost.Polygon's Voronoi diagram: exact predicates on a grid of 2⁻²⁹ of the
// extent.
std::vector<std::uint32_t> BoundaryRing(std::span<const Eigen::Vector2d> points, double radius);

}  // namespace frond
