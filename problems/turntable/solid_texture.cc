// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/solid_texture.h"

#include <array>
#include <cmath>

namespace frond {
namespace {

// Mixes a 32-bit word so that neighbours share no pattern (Wellons' `lowbias32`).
std::uint32_t Mix(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352dU;
  h = (h ^ (h >> 15)) * 0x846ca68bU;
  return h ^ (h >> 16);
}

std::array<double, 4> SplineWeights(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
          t * t * t / 6};
}

// Uniform values in [−1, 1] have a variance of 1/3; the weights' squares add up to 151/315 a dimension on
// average.
const double kUnitDeviation = std::sqrt(3.0) / std::pow(151.0 / 315, 1.5);
constexpr double kHalfRange = 2147483648.0;

}  // namespace

double SolidTexture::Value(const Eigen::Vector3d& point) const {
  std::array<std::array<double, 4>, 3> weights{};
  std::array<std::uint32_t, 3> base{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double place = point[static_cast<Eigen::Index>(k)] * scale_, floor = std::floor(place);
    base[k] = static_cast<std::uint32_t>(static_cast<std::int64_t>(floor));
    weights[k] = SplineWeights(place - floor);
  }
  double sum = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t plane = Mix(base[2] + i + seed_);
    double of_plane = 0;
    for (std::uint32_t j = 0; j < 4; ++j) {
      const std::uint32_t row = Mix(plane ^ (base[1] + j));
      double of_row = 0;
      for (std::uint32_t k = 0; k < 4; ++k) {
        const double value = static_cast<double>(Mix(row ^ (base[0] + k))) / kHalfRange - 1;
        of_row += weights[0][k] * value;
      }
      of_plane += weights[1][j] * of_row;
    }
    sum += weights[2][i] * of_plane;
  }
  return sum * kUnitDeviation;
}

}  // namespace frond
