// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/sheet_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "models/knot_vector.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

TEST(RectangleParameters, MapTheBoxOntoTheDomainLessItsMargin) {
  const Points box{{10, -5, 0}, {70, 15, 3}};
  const Points points{{10, -5, 9}, {70, 15, 9}, {40, 5, 9}, {10, 15, 9}};
  const auto uv = RectangleParameters(points, box, 0.02);
  EXPECT_TRUE(uv[0].isApprox(Eigen::Vector2d(0.02, 0.02), 1e-14));
  EXPECT_TRUE(uv[1].isApprox(Eigen::Vector2d(0.98, 0.98), 1e-14));
  EXPECT_TRUE(uv[2].isApprox(Eigen::Vector2d(0.5, 0.5), 1e-14));
  EXPECT_TRUE(uv[3].isApprox(Eigen::Vector2d(0.98, 0.02), 1e-14));  // u along y, v along x
}

TEST(RectangleParameters, OfPointsOutsideTheBox_StayInTheDomain) {
  const auto uv = RectangleParameters(Points{{-100, 200, 0}}, Points{{0, 0, 0}, {1, 1, 1}}, 0.02);
  EXPECT_EQ(uv[0], Eigen::Vector2d(1, 0));
}

Points Ellipse(int count) {
  Points ring;
  for (int k = 0; k < count; ++k) {
    const double a = 2 * M_PI * k / count;
    ring.emplace_back(30 * std::cos(a), 10 * std::sin(a) + 2, 0.1 * k);
  }
  return ring;
}

TEST(OutlineParameters, PutTheOutlineOnTheDomainsEdges) {
  const Points ring = Ellipse(720);
  for (const double x : {-24.0, -10.0, 0.0, 3.7, 20.0, 28.0}) {
    const double half = 10 * std::sqrt(1 - x * x / 900);
    const auto uv = OutlineParameters(Points{{x, 2 - half, 0}, {x, 2, 5}, {x, 2 + half, 0}}, ring);
    EXPECT_NEAR(uv[0][0], 0, 0.01) << x;
    EXPECT_NEAR(uv[1][0], 0.5, 0.01) << x;
    EXPECT_NEAR(uv[2][0], 1, 0.01) << x;
    EXPECT_NEAR(uv[1][1], (x + 30) / 60, 1e-6) << x;
  }
}

TEST(OutlineParameters, OfPointsBeyondTheRing_StayInTheDomain) {
  Random random(4);
  Points points;
  for (int i = 0; i < 500; ++i) points.emplace_back(random.Uniform(-60, 60), random.Uniform(-40, 40), 0);
  for (const auto& uv : OutlineParameters(points, Ellipse(90))) {
    EXPECT_TRUE(uv.minCoeff() >= 0 && uv.maxCoeff() <= 1) << uv.transpose();
  }
}

TEST(FootParameters, OfPointsOnASurface_AreTheirOwnScaledToTheUnitSquare) {
  const NurbsSurface surface = MakeSurface({.uneven_knots = true, .roughness = 0.15});
  Random random(5);
  Points points;
  std::vector<Eigen::Vector2d> expected;
  for (int i = 0; i < 300; ++i) {
    expected.emplace_back(random.Uniform(), random.Uniform());
    points.push_back(surface.Evaluate(0.5 + 1.5 * expected.back()[0], -1 + 1.7 * expected.back()[1]));
  }
  for (const int threads : {1, 2}) {
    const auto uv = FootParameters(points, surface, threads);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_TRUE(uv[i].isApprox(expected[i], 1e-6)) << i;
  }
}

}  // namespace
}  // namespace frond
