// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "problems/surface/closed_start.h"

namespace frond {

// A noisy scan, even by area, of a shape closed round the x axis, with its truth.
struct ClosedCloud {
  std::vector<Eigen::Vector3d> points;   // with noise along the normal
  std::vector<Eigen::Vector3d> clean;    // without
  std::vector<Eigen::Vector3d> normals;  // outwards
  std::vector<Eigen::Vector2d> place;    // turns round the axis, and from 0 to 1 along it
  std::vector<Ring> rims;                // true ones, at the axis's begin first
};

// Where `open` < 1 the part below that share of the axis from −x: a cup with its rim in a plane.
ClosedCloud EllipsoidCloud(const Eigen::Vector3d& radii, int count, double noise, double open = 1,
                           std::uint64_t seed = 1);

// A body of revolution, `radius` thick, with a dimple at both poles.
ClosedCloud AppleCloud(double radius, int count, double noise, std::uint64_t seed = 1);

// A tube round an arc of `bend` radians in the x-y plane (0: straight along x), thicker in its middle.
ClosedCloud TubeCloud(double radius, double length, double bend, int count, double noise,
                      std::uint64_t seed = 1);

}  // namespace frond
