// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace frond {

// A part of a torus of radius 4 whose tube's radius changes along it, r = 1 + 0.2 cos(3 bend): points spread
// evenly over bend and the tube's angle, moved along the radius by noise.
struct BentTube {
  double degrees = 150;
  double noise = 0.005;
  int points = 6000;

  static double Radius(double bend);
  Eigen::Vector3d At(double bend, double angle, double offset = 0) const;
  std::vector<Eigen::Vector3d> Scan(std::uint64_t seed) const;
};

}  // namespace frond
