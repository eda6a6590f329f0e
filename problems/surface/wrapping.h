// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace frond {

// How a surface lies about an axis. `ring_share`: the share of the surface in slabs across the axis whose cut
// encloses a hole. `projected`: the mean of |n · axis|, which is the area of its projection along the axis
// over its area. `evenness`: the smaller over the larger principal moment of the normals across the axis, 1
// for a circular cross-section, 0.13 for an ellipse of 4 : 1, below 0.05 for a curled leaf closed like a
// boat.
struct Wrapping {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double ring_share = 0, projected = 1, evenness = 0;

  // A hemisphere has rings all over and is projected to a half.
  bool round() const { return ring_share >= 0.6 && projected <= 0.6 && evenness >= 0.1; }
};

// About that of the principal axes of the points and of their normals that has the largest ring_share minus
// projected. Points within `resolution` are taken to be connected. Linear but for sorting.
Wrapping FindWrapping(std::span<const Eigen::Vector3d> points, double resolution);

}  // namespace frond
