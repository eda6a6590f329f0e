// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// Of a set in space: b₀ components, b₁ loops that nothing in the set fills, b₂ cavities.
struct BettiNumbers {
  int components = 0, loops = 0, cavities = 0;
  bool operator==(const BettiNumbers&) const = default;
};

// Cubes in a box, x fastest. A margin of at least one cube about what is filled stays empty.
struct VoxelSet {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  double side = 1;
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  // of cube 0
  std::vector<std::uint8_t> filled;

  std::size_t Index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(size.x()) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(z));
  }
};

// The cubes, of side radius / 2, whose centres are no farther than `radius` from a point. The box is along
// the coordinate axes.
VoxelSet UnionOfBalls(std::span<const Eigen::Vector3d> points, double radius);

// Empties components (26-connected) that hold less than `share` of the points; returns the points in the
// others.
std::size_t DropSmallComponents(std::span<const Eigen::Vector3d> points, double share, VoxelSet* voxels);

// Of the filled cubes, closed: cubes that share a corner touch, and cavities are the parts of the rest that
// are connected by faces of cubes. Cavities of less than `least` cubes are filled first. b₁ = b₀ + b₂ − χ,
// χ counted over 2 × 2 × 2 neighbourhoods (Toriwaki and Yonekura 2002). Linear in the cubes of the box.
BettiNumbers FindBettiNumbers(VoxelSet* voxels, std::size_t least);

// The share of the filled cubes that are more than `layers` cubes, counted over faces, away from an empty
// one.
double DeepShare(const VoxelSet& voxels, int layers);

}  // namespace frond
