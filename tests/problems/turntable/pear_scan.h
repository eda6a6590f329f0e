// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/random.h"
#include "problems/turntable/scan_point.h"

namespace frond {

// A pear about 100 high that stands on the disk: a body of revolution with three shallow lobes, so that its
// shape tells how it is turned.
//   ρ = 30 sin t (1 − .35 cos t) (1 + lobes sin² t cos 3u),  z = 50 (1 + cos t),  t from the top.
struct LobedPear {
  double lobes = 0.04;

  Eigen::Vector3d At(double u, double t) const;      // u, t in radians
  Eigen::Vector3d Normal(double u, double t) const;  // outwards
  // The nearest point of the pear.
  double SignedDistance(const Eigen::Vector3d& point) const;
};

// Even by area between the polar angles t, with `noise` along the normal.
std::vector<Eigen::Vector3d> PearPoints(const LobedPear& pear, int count, double first_t, double last_t,
                                        double noise, Random* random);

// What a camera 600 away at height 50, seen from the disk at `angle` (radians), sees of the pear: points
// about `spacing` apart in its image, with noise of `sigma` along the ray, growing with the slant.
std::vector<ScanPoint> PearView(const LobedPear& pear, double angle, double spacing, double sigma, int view,
                                Random* random);

}  // namespace frond
