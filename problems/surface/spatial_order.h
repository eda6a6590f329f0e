// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// The order of the points along a Z-curve (Morton codes) through their bounding box: neighbours in space
// stand near each other in memory, every k-th point is an even thinning, and a result that follows from this
// order does not depend on the order in the file. Ties (equal codes) are broken by the coordinates.
std::vector<std::uint32_t> SpatialOrder(std::span<const Eigen::Vector3d> points);

}  // namespace frond
