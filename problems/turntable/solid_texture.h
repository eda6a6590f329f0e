// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace frond {

// A speckle that fills space: the pattern of an object carved from it is that of its surface points. Random
// values on a cubic lattice under cubic B-splines: twice continuously differentiable, with next to nothing
// (0.2 %) above one period a lattice step, so that pixels smaller than half a step do not alias.
class SolidTexture {
 public:
  // `grain`: the lattice step, in the points' unit.
  SolidTexture(std::uint32_t seed, double grain) : seed_(seed), scale_(1 / grain) {}

  // Mean 0, standard deviation 1 over space.
  double Value(const Eigen::Vector3d& point) const;

 private:
  std::uint32_t seed_;
  double scale_;
};

}  // namespace frond
