// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/closed_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"
#include "models/kd_tree.h"
#include "problems/surface/outliers.h"
#include "tests/problems/surface/closed_clouds.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;
constexpr double kPi = std::numbers::pi;

// How far u is from the true turn at the worst, the seam and the sense of turning being free.
double LargestTurnError(const ClosedCloud& cloud, const std::vector<Eigen::Vector2d>& parameters,
                        double from = 0, double to = 1) {
  double least = 1;
  for (const double sense : {1.0, -1.0}) {
    const auto turn = [&](std::size_t i) { return parameters[i][0] - sense * cloud.place[i][0]; };
    std::complex<double> mean = 0;
    for (std::size_t i = 0; i < parameters.size(); ++i) mean += std::polar(1.0, 2 * kPi * turn(i));
    double largest = 0;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (cloud.place[i][1] < from || cloud.place[i][1] > to) continue;
      const double off = turn(i) - std::arg(mean) / (2 * kPi);
      largest = std::max(largest, std::abs(off - std::round(off)));
    }
    least = std::min(least, largest);
  }
  return least;
}

// The correlation of v's ranks with those of the true place along the axis.
double RankCorrelation(const ClosedCloud& cloud, const std::vector<Eigen::Vector2d>& parameters) {
  const std::size_t n = parameters.size();
  const auto ranks = [&](const auto& value) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return value(a) < value(b); });
    std::vector<double> rank(n);
    for (std::size_t k = 0; k < n; ++k)
      rank[order[k]] = static_cast<double>(k) / static_cast<double>(n - 1) - 0.5;
    return rank;
  };
  const auto a = ranks([&](std::size_t i) { return parameters[i][1]; });
  const auto b = ranks([&](std::size_t i) { return cloud.place[i][1]; });
  double ab = 0, aa = 0;
  for (std::size_t i = 0; i < n; ++i) {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
  }
  return ab / aa;
}

void ExpectInUnitSquare(const std::vector<Eigen::Vector2d>& parameters) {
  for (const auto& uv : parameters) {
    ASSERT_TRUE(uv[0] >= 0 && uv[0] < 1 && uv[1] >= 0 && uv[1] <= 1) << uv.transpose();
  }
}

TEST(SphericalParameters, AreTheAnglesAboutTheXAxis) {
  Random random(1);
  Points points;
  std::vector<Eigen::Vector2d> expected;
  for (int k = 0; k < 200; ++k) {
    const double u = random.Uniform(0.01, 0.99), v = random.Uniform(0.01, 0.99), r = random.Uniform(0.1, 9);
    const double angle = 2 * kPi * u, polar = kPi * v;
    expected.emplace_back(u, v);
    points.emplace_back(r * Eigen::Vector3d(-std::cos(polar), std::sin(polar) * std::cos(angle),
                                            std::sin(polar) * std::sin(angle)));
  }
  const auto parameters = SphericalParameters(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((parameters[i] - expected[i]).norm(), 1e-12);
  const Points poles = {{-3, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  const auto at_poles = SphericalParameters(poles);
  EXPECT_EQ(at_poles[0][1], 0);
  EXPECT_EQ(at_poles[1][1], 1);
  ExpectInUnitSquare(at_poles);
}

TEST(GeodesicParameters, OfABentTube_RunAlongAndRoundIt) {
  for (const double bend : {0.0, 1.5, 3.0}) {
    const ClosedCloud tube = TubeCloud(5, 60, bend, 2500, 0);
    const auto parameters = GeodesicParameters(tube.points, SurfaceTopology::kTube, tube.rims);
    ExpectInUnitSquare(parameters);
    EXPECT_GT(RankCorrelation(tube, parameters), 0.99) << bend;
    EXPECT_LT(LargestTurnError(tube, parameters), 0.08) << bend;
    // v from the first rim to the second, not the other way.
    const auto turned = GeodesicParameters(tube.points, SurfaceTopology::kTube, {tube.rims[1], tube.rims[0]});
    for (std::size_t i = 0; i < turned.size(); ++i) ASSERT_NEAR(turned[i][1], 1 - parameters[i][1], 1e-12);
  }
}

TEST(GeodesicParameters, OfACup_RunFromItsPoleToTheRim) {
  const ClosedCloud cup = EllipsoidCloud({40, 20, 18}, 2500, 0, 0.6);
  const auto parameters = GeodesicParameters(cup.points, SurfaceTopology::kCup, cup.rims);
  ExpectInUnitSquare(parameters);
  EXPECT_GT(RankCorrelation(cup, parameters), 0.99);
  EXPECT_LT(LargestTurnError(cup, parameters, 0.3), 0.08);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    EXPECT_TRUE(cup.place[i][1] < 0.98 || parameters[i][1] > 0.9);
    EXPECT_TRUE(cup.place[i][1] > 0.04 || parameters[i][1] < 0.2);
  }
}

TEST(GeodesicParameters, OfALongSphere_RunFromTipToTip) {
  const ClosedCloud sphere = EllipsoidCloud({40, 12, 10}, 2500, 0);
  const auto parameters = GeodesicParameters(sphere.points, SurfaceTopology::kSphere, {});
  ExpectInUnitSquare(parameters);
  EXPECT_GT(std::abs(RankCorrelation(sphere, parameters)), 0.99);
  EXPECT_LT(LargestTurnError(sphere, parameters, 0.2, 0.8), 0.1);
}

TEST(GeodesicParameters, WhereNothingJoinsTheEnds_IsAFitError) {
  const ClosedCloud left = TubeCloud(5, 20, 0, 500, 0), right = TubeCloud(5, 20, 0, 500, 0);
  Points both = left.points;
  for (const auto& point : right.points) both.emplace_back(point + Eigen::Vector3d(500, 0, 0));
  Ring far = right.rims[1];
  for (auto& point : far) point.x() += 500;
  EXPECT_THROW(GeodesicParameters(both, SurfaceTopology::kTube, {left.rims[0], far}), FitError);
}

double Spacing(const Points& points) { return PointSpacing(points, KdTree(points)); }

// Once round the x axis, each way from point to point less than half a turn.
double TurnsOf(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
    const double step = std::atan2(b.z(), b.y()) - std::atan2(a.z(), a.y());
    sum += step - 2 * kPi * std::round(step / (2 * kPi));
  }
  return sum / (2 * kPi);
}

void ExpectRimAt(const Ring& ring, double x, double spacing) {
  ASSERT_GE(ring.size(), 12U);
  EXPECT_NEAR(std::abs(TurnsOf(ring)), 1, 1e-9);
  double sum = 0, farthest = 0;
  for (const auto& point : ring) {
    sum += std::abs(point.x() - x) / static_cast<double>(ring.size());
    farthest = std::max(farthest, std::abs(point.x() - x));
  }
  EXPECT_LT(sum, spacing);
  EXPECT_LT(farthest, 4 * spacing);
}

double Farthest(const Points& from, const Points& to) {
  double most = 0;
  for (const auto& point : from) {
    const KdTree tree(to);
    most = std::max(most, std::sqrt(tree.Nearest(point).squared_distance));
  }
  return most;
}

TEST(Rims, OfNoisyTubes_AreTheirEnds) {
  for (const double bend : {0.0, 0.8, 1.6, 2.5}) {
    const ClosedCloud tube = TubeCloud(8, 70, bend, 3000, 0.05);
    const double spacing = Spacing(tube.points);
    const auto guess = GuessRims(tube.points, SurfaceTopology::kTube, spacing);
    ASSERT_EQ(guess.size(), 2U);
    const std::size_t turned = Farthest(guess[0], tube.rims[0]) > 20 ? 1 : 0;
    const auto rims = FindRims(tube.points, SurfaceTopology::kTube, guess, spacing);
    ASSERT_EQ(rims.size(), 2U);
    for (const std::size_t end : {0, 1}) {
      const Ring& truth = tube.rims[end == turned ? 0 : 1];
      EXPECT_LT(Farthest(guess[end], truth), 3 * spacing) << bend;
      EXPECT_LT(Farthest(truth, guess[end]), 3 * spacing) << bend;
      EXPECT_LT(Farthest(truth, rims[end]), 3 * spacing) << bend;
      if (bend == 0) ExpectRimAt(rims[end], truth[0].x(), spacing);
    }
  }
}

TEST(Rims, OfACup_AreThatOfItsOpenEnd) {
  for (const double open : {0.4, 0.5, 0.7, 0.85}) {
    const ClosedCloud cup = EllipsoidCloud({30, 18, 16}, 3000, 0.05, open);
    const double spacing = Spacing(cup.points), x = -30 + 60 * open;
    const auto guess = GuessRims(cup.points, SurfaceTopology::kCup, spacing);
    ASSERT_EQ(guess.size(), 1U);
    EXPECT_LT(Farthest(guess[0], cup.rims[0]), 4 * spacing) << open;
    EXPECT_LT(Farthest(cup.rims[0], guess[0]), 4 * spacing) << open;
    const auto rims = FindRims(cup.points, SurfaceTopology::kCup, guess, spacing);
    ASSERT_EQ(rims.size(), 1U);
    ExpectRimAt(rims[0], x, spacing);
  }
}

TEST(Rims, OfACloudThatHasTooFew_AreAFitError) {
  const ClosedCloud sphere = EllipsoidCloud({30, 20, 20}, 2000, 0);
  const double spacing = Spacing(sphere.points);
  EXPECT_THROW(GuessRims(sphere.points, SurfaceTopology::kCup, spacing), FitError);
  const ClosedCloud cup = EllipsoidCloud({30, 18, 16}, 2000, 0, 0.6);
  EXPECT_THROW(GuessRims(cup.points, SurfaceTopology::kTube, Spacing(cup.points)), FitError);
}

TEST(Rims, OfASphere_AreNone) {
  const ClosedCloud sphere = EllipsoidCloud({3, 2, 2}, 500, 0);
  EXPECT_TRUE(FindRims(sphere.points, SurfaceTopology::kSphere, {}, 0.1).empty());
}

}  // namespace
}  // namespace frond
