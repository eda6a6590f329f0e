// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "models/kd_tree.h"

namespace frond {

// The spacing h of a surface scan: the radius that holds 8 neighbours, r = h √(8/π) at even density; the
// median over up to 2,000 evenly chosen points.
double PointSpacing(std::span<const Eigen::Vector3d> points, const KdTree& tree);

// Points that are not of the sheet, as 1: those in sparse places (a tenth of the usual number of points
// within about four spacings, or fewer than four), and of the rest those not connected with the largest part
// (cubes of side 5 spacings that touch are connected). The cubes stand along the coordinate axes,
// symmetrically about the origin: for an answer that does not depend on the pose give points in their
// principal axes about their mean, with any signs. None where that part is less than half of the points, or
// they are fewer than 10. Linear in time and memory.
std::vector<std::uint8_t> StrayPoints(std::span<const Eigen::Vector3d> points);

// Points that stand out from their surroundings, as 1: |o_i − median of the 12 nearest points' o| > threshold
// · σ with o the offsets from a surface (point less foot), the median by coordinates, σ = 1.4826 · the median
// of that length over a sample, threshold · σ at least half a spacing of the points. What a whole
// neighbourhood has in common is the surface's error, not an outlier's; nor is a point one that lies within
// half of that of the plane through those neighbours and within three spacings of the nearest point that does
// not stand out.
std::vector<std::uint8_t> OutlyingPoints(std::span<const Eigen::Vector3d> points,
                                         std::span<const Eigen::Vector3d> offsets, const KdTree& tree,
                                         double threshold);

}  // namespace frond
