// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/local_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

// A saddle of some curvature with noise σ along its normal, about.
std::vector<Eigen::Vector3d> NoisySaddle(double sigma) {
  Random random(8);
  std::vector<Eigen::Vector3d> points;
  for (const auto& p : JitteredSquare(80, 3)) {
    points.emplace_back(p.x(), p.y(), 0.3 * p.x() * p.x() - 0.2 * p.y() * p.y() + sigma * random.Normal());
  }
  return points;
}

double NoiseOf(const std::vector<Eigen::Vector3d>& points) {
  return LocalNoise(points, std::vector<std::uint8_t>(points.size(), 0), KdTree(points));
}

TEST(LocalNoise, OfACurvedSheet_IsInProportionToItsNoise) {
  const double one = NoiseOf(NoisySaddle(0.001)), two = NoiseOf(NoisySaddle(0.002));
  EXPECT_GT(one, 0.4 * 0.001);
  EXPECT_LT(one, 1.6 * 0.001);
  EXPECT_NEAR(two / one, 2, 0.2);
}

TEST(LocalNoise, OfACleanSheet_IsNearNone) { EXPECT_LT(NoiseOf(NoisySaddle(0)), 1e-6); }

TEST(LocalNoise, ScalesWithTheUnit) {
  std::vector<Eigen::Vector3d> points = NoisySaddle(0.001);
  const double noise = NoiseOf(points);
  for (auto& point : points) point *= 1000;
  EXPECT_NEAR(NoiseOf(points), 1000 * noise, 1e-6 * 1000 * noise);
}

}  // namespace
}  // namespace frond
