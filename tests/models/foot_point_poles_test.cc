// SPDX-License-Identifier: BSD-3-Clause
// Feet on surfaces with poles, which are points like others: steps lead over them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"
#include "models/foot_point_search.h"
#include "tests/models/closed_surfaces.h"

namespace frond {
namespace {

// The least squared distance by a grid of samples, refined about the best one until it is 1e-7 wide.
double BruteForce(const SurfaceCells& cells, const Eigen::Vector3d& point) {
  constexpr int kGrid = 60;
  double half_u = 0.5, half_v = 0.5;
  Eigen::Vector2d best(0.5, 0.5);
  double least = std::numeric_limits<double>::infinity();
  while (half_v > 1e-7) {
    const Eigen::Vector2d centre = best;
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; j <= kGrid; ++j) {
        const double u = centre[0] + half_u * (2.0 * i / kGrid - 1);
        const double v = std::clamp(centre[1] + half_v * (2.0 * j / kGrid - 1), 0.0, 1.0);
        const double squared = (cells.Evaluate(cells.basis_u().IntoDomain(u), v) - point).squaredNorm();
        if (squared < least) {
          least = squared;
          best = {u, v};
        }
      }
    }
    half_u = std::min(half_u, std::max(half_v, 0.02)) / 4;  // near a pole u is worth little
    half_v /= 8;
  }
  return least;
}

// Points off the surface over its last few hundredths of v at a pole, on both sides of it.
std::vector<Eigen::Vector3d> PointsAtPole(const NurbsSurface& surface, bool end, int count) {
  Random random(4);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const double v = random.Uniform(0, 0.12);
    const SurfacePoint at = surface.EvaluateWithDerivatives(random.Uniform(), end ? 1 - v : v);
    points.push_back(at.position + random.Uniform(-1, 2) * at.Normal());
  }
  return points;
}

TEST(FootPointAtPole, NearAndBeyondThePole_IsThatOfBruteForce) {
  const NurbsSurface egg = Egg({.begin = true, .end = true});
  const SurfaceCells cells(egg);
  ASSERT_TRUE(cells.poles().begin && cells.poles().end);
  const FootPointSearch search(cells);
  for (const bool end : {false, true}) {
    for (const auto& point : PointsAtPole(egg, end, 40)) {
      const FootPoint foot = search.Find(point, FootPointSearch::kThorough);
      EXPECT_NEAR(std::sqrt(foot.squared_distance), std::sqrt(BruteForce(cells, point)), 1e-5);
      EXPECT_TRUE(foot.converged);
      EXPECT_FALSE(foot.at_edge_u);
      EXPECT_FALSE(foot.at_edge_v);
    }
  }
}

TEST(FootPointAtPole, StartOnTheOtherSide_ComesAcross) {
  const SurfaceCells cells(Egg({.begin = true, .end = true}, 0));
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const double u = random.Uniform(), v = random.Uniform(1e-3, 0.08), off = random.Uniform(-0.5, 0.5);
    for (const bool end : {false, true}) {
      const double at = end ? 1 - v : v;
      const SurfaceCells::Jet1 jet = cells.Evaluate1(u, at);
      const Eigen::Vector3d point = jet.position + off * jet.du.cross(jet.dv).normalized();
      const FootPoint foot =
          RefineFootPoint(cells, point, u + 0.5, end ? 1 - random.Uniform(0, 0.05) : random.Uniform(0, 0.05),
                          {.step_tolerance = 1e-6});
      EXPECT_NEAR(std::sqrt(foot.squared_distance), std::abs(off), 1e-6) << u << ' ' << at;
      EXPECT_FALSE(foot.at_edge_v);
    }
  }
}

TEST(FootPointAtPole, PointOverThePoleItself_HasItsFootThere) {
  const double r = 3;
  const NurbsSurface sphere = TurnedSphere(r);
  const SurfaceCells cells(sphere);
  const FootPointSearch search(cells);
  for (const double z : {-4.0, 4.0, -2.5, 2.5}) {
    const FootPoint foot = search.Find({0, 0, z});
    EXPECT_NEAR(std::sqrt(foot.squared_distance), std::abs(std::abs(z) - r), 1e-8);
    EXPECT_FALSE(foot.at_edge_v);
    EXPECT_LT((cells.Evaluate(foot.u, foot.v) - Eigen::Vector3d(0, 0, z > 0 ? r : -r)).norm(), 1e-4);
  }
}

TEST(FootPointAtPole, OnASphere_IsTheRadialProjection) {
  const double r = 3;
  const NurbsSurface sphere = TurnedSphere(r);
  const SurfaceCells cells(sphere);
  const FootPointSearch search(cells);
  Random random(6);
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector3d direction(0.2 * random.Normal(), 0.2 * random.Normal(), random.Normal());
    const double radius = random.Uniform(2, 5);
    const FootPoint foot = search.Find(radius * direction.normalized());
    EXPECT_NEAR(std::sqrt(foot.squared_distance), std::abs(radius - r), 1e-5);
    EXPECT_LT((cells.Evaluate(foot.u, foot.v) - r * direction.normalized()).norm(), 1e-4);
    EXPECT_FALSE(foot.at_edge_u || foot.at_edge_v);
  }
}

TEST(FootPointAtPole, BeyondTheOpenRimOfACup_IsOnTheEdge) {
  const SurfaceCells cells(TurnedCup(3));
  EXPECT_TRUE(cells.poles().begin);
  EXPECT_FALSE(cells.poles().end);
  const FootPoint foot = FootPointSearch(cells).Find({4, 0.5, 2});
  EXPECT_TRUE(foot.at_edge_v);
  EXPECT_FALSE(foot.at_edge_u);
  EXPECT_EQ(foot.v, 1);
  EXPECT_FALSE(FootPointSearch(cells).Find({0.1, 0, -5}).at_edge_v);
}

}  // namespace
}  // namespace frond
