// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/kd_tree.h"
#include "problems/skinning/section_planes.h"

namespace frond {

// The points of a cloud that stand for its section by a plane (acquisition paper, section 3.3): those within
// `tolerance` of it, moved along the surface (LocalQuadric) into the plane, so that a slope of the surface or
// points that lie on one side do not bias the section. The tolerance is measured along the surface too, which
// keeps as many points where it lies flat. Of several parts that the plane cuts (parts nearer than `gap` are
// one) the one nearest to the plane's origin. Empty where the plane misses the cloud. `tree` over `points`.
std::vector<Eigen::Vector3d> SectionPoints(std::span<const Eigen::Vector3d> points, const KdTree& tree,
                                           const SectionPlane& plane, double tolerance, double gap);

// The centroid of the area that a closed section's points surround, taken in the order of their angle about
// the plane's origin; their mean where they surround none.
Eigen::Vector3d SectionCentroid(std::span<const Eigen::Vector3d> section, const SectionPlane& plane);

}  // namespace frond
