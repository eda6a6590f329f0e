// SPDX-License-Identifier: BSD-3-Clause
// Base-surface parameters (Ma) for clouds that close round an axis: u round it, v along it, both in [0, 1].
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "problems/surface/surface_topology.h"

namespace frond {

using Ring = std::vector<Eigen::Vector3d>;

// Spherical angles about the origin: v = θ / π from the axis −x to +x, u the angle round it.
std::vector<Eigen::Vector2d> SphericalParameters(std::span<const Eigen::Vector3d> points);

// Whether every ray from the origin meets a closed cloud about once, so that those angles tell its points
// apart: among points in nearly the same direction the distances differ by less than a third (in all but 2 %
// of the directions).
bool IsStarShaped(std::span<const Eigen::Vector3d> points);

// By a cylinder about the x axis: v along it from end to end, u the angle round it.
std::vector<Eigen::Vector2d> CylinderParameters(std::span<const Eigen::Vector3d> points);

// For shapes that bend: v = d₀ / (d₀ + d₁) with the distances along the cloud (paths through nearest
// neighbours) to v's two ends, u the angle round the line through the middles of the levels of v, measured
// from a direction carried along it without twist. Exact where points stand evenly, near enough elsewhere.
//
// An end is a rim, or a pole: a point. A cup's v runs from its pole, the farthest point from the rim, to the
// rim; a sphere's poles are its two points farthest apart. `rims`: points on each rim, two for a tube, one
// for a cup. Points that no path joins to the ends are left half-way between them; FitError where they are
// more than a twentieth.
std::vector<Eigen::Vector2d> GeodesicParameters(std::span<const Eigen::Vector3d> points,
                                                SurfaceTopology topology, const std::vector<Ring>& rims);

// The ends of a cloud without faces, roughly, v = 0's before v = 1's along its longest principal direction:
// the widest parts (two of a tube, one of a cup) that its boundary points make, those about which the nearest
// 40, seen in the plane fitted to them, leave a gap of more than 120 degrees (the angle criterion of Bendels,
// Schnabel and Klein 2006, "Detecting holes in point set surfaces"). `spacing` of the points, wider than
// their noise. FitError where there are fewer parts.
std::vector<Ring> GuessRims(std::span<const Eigen::Vector3d> points, SurfaceTopology topology,
                            double spacing);

// The rims in order round them, as closed polygons, v = 0's before v = 1's, from points roughly there (as
// above): BoundaryRing of the points near an end in a plane with polar coordinates, of which the distance
// along the cloud from the other end is the radius. `spacing` of the points. None for a sphere. Throws as
// above.
std::vector<Ring> FindRims(std::span<const Eigen::Vector3d> points, SurfaceTopology topology,
                           const std::vector<Ring>& guess, double spacing);

}  // namespace frond
