// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// One point for each occupied cube of a grid: the mean of the points in it (Connolly 1984), in the grid's
// order. `corner`: any corner of the grid. Throws ConfigError unless edge > 0, InputError where the grid
// would have more than 2²¹ cubes along an axis.
std::vector<Eigen::Vector3d> VoxelGridMeans(std::span<const Eigen::Vector3d> points, double edge,
                                            const Eigen::Vector3d& corner);

// About `count` points by a voxel grid: the edge is sought by bisection (the number of occupied cubes is
// within a few per cent, as close as it comes), the grid's place is drawn from `seed`. All points where there
// are no more than `count`.
std::vector<Eigen::Vector3d> DownsampleByVoxelGrid(std::span<const Eigen::Vector3d> points, std::size_t count,
                                                   std::uint64_t seed);

}  // namespace frond
