// SPDX-License-Identifier: BSD-3-Clause
#include "bent_tube.h"

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace frond {

double BentTube::Radius(double bend) { return 1 + 0.2 * std::cos(3 * bend); }

Eigen::Vector3d BentTube::At(double bend, double angle, double offset) const {
  const double r = Radius(bend) + offset, ring = 4 + r * std::cos(angle);
  return {ring * std::cos(bend), ring * std::sin(bend), r * std::sin(angle)};
}

std::vector<Eigen::Vector3d> BentTube::Scan(std::uint64_t seed) const {
  Random random(seed);
  std::vector<Eigen::Vector3d> scan;
  for (int k = 0; k < points; ++k) {
    const double bend = random.Uniform(0, degrees * std::numbers::pi / 180);
    scan.push_back(At(bend, random.Uniform(0, 2 * std::numbers::pi), noise * random.Normal()));
  }
  return scan;
}

}  // namespace frond
