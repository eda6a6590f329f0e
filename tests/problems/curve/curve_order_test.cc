// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/knot_vector.h"
#include "problems/curve/curve_parameters.h"
#include "problems/curve/parametric_start.h"
#include "tests/problems/curve/curve_cases.h"

namespace frond {
namespace {

TEST(FindChain, OfShuffledPoints_FollowsTheCurve) {
  for (const double noise : {0.0, 0.05, 0.2}) {
    const PointChain open =
        FindChain(Shuffled(WithNoise(HelixPoints(500), noise, 1, false), 2), std::nullopt);
    EXPECT_FALSE(open.closed) << noise;
    // z rises along the helix.
    const bool up = open.vertices.back().z() > open.vertices.front().z();
    EXPECT_LT(std::min(open.vertices.front().z(), open.vertices.back().z()), 1) << noise;
    EXPECT_GT(std::max(open.vertices.front().z(), open.vertices.back().z()), 9) << noise;
    const std::size_t tenth = open.vertices.size() / 10;  // steps within the noise may go back
    for (std::size_t k = tenth; k < open.vertices.size(); k += tenth) {
      EXPECT_EQ(open.vertices[k].z() > open.vertices[k - tenth].z(), up) << noise << " " << k;
    }
    const PointChain closed =
        FindChain(Shuffled(WithNoise(OutlinePoints(500), noise, 3, true), 4), std::nullopt);
    EXPECT_TRUE(closed.closed) << noise;
    double turn = 0;
    for (std::size_t k = 0; k < closed.vertices.size(); ++k) {
      const Eigen::Vector3d &a = closed.vertices[k], &b = closed.vertices[(k + 1) % closed.vertices.size()];
      turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    EXPECT_NEAR(std::abs(turn), 2 * std::numbers::pi, 1e-9) << noise;
  }
}

TEST(FindChain, OfPartsAndBranches_IsRefused) {
  Points circles = EllipsePoints(100, 3, 3, 0, 2 * std::numbers::pi), fork;
  for (int i = 0; i < 100; ++i)
    circles.push_back(circles[static_cast<std::size_t>(i)] + Eigen::Vector3d(12, 0, 0));
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 50; ++i) {
      const double angle = 2 * std::numbers::pi * k / 3;
      fork.push_back(0.1 * i * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    }
  }
  EXPECT_THROW(FindChain(Shuffled(circles, 1), std::nullopt), InputError);
  EXPECT_THROW(FindChain(Shuffled(fork, 1), std::nullopt), InputError);
}

TEST(LooksClosed, TellsACircleFromAnArc) {
  EXPECT_TRUE(LooksClosed(EllipsePoints(50, 3, 3, 0, 2 * std::numbers::pi)));
  EXPECT_FALSE(LooksClosed(EllipsePoints(50, 3, 3, 0, 1.8 * std::numbers::pi)));
}

TEST(LocatePoints, OnABaseCircle_AreTheirAngles) {
  CurveFitOptions options;
  options.closed = true;
  options.parametrisation = CurveParametrisation::kBaseCurve;
  options.base = BaseCurve::kCircle;
  options.base_repeats = 0;
  const LocatedPoints located =
      LocatePoints(Shuffled(EllipsePoints(40, 5, 5, 0.1, 2 * std::numbers::pi), 1), options);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(located.parameters[i], static_cast<double>(i) / 40, 1e-12);
  }
  options.base = BaseCurve::kLine;
  EXPECT_THROW(LocatePoints(HelixPoints(30), options), ConfigError);
}

// Points at parameters of a rational curve: M w = 0 has its weights as solution.
TEST(MaWeights, OfPointsOnARationalCurve_AreItsWeights) {
  const BSplineBasis basis = UniformBasis(3, 7);
  const std::vector<double> weights = {1, 2, 0.5, 1, 1.5, 0.7, 1};
  std::vector<Eigen::Vector3d> control_points;
  for (int k = 0; k < 7; ++k) control_points.emplace_back(k, std::sin(1.0 + 2 * k), 0.2 * k * k);
  const NurbsCurve curve(basis, control_points, weights);
  Points points;
  std::vector<double> parameters;
  for (int i = 0; i <= 100; ++i) {
    parameters.push_back(i / 100.0);
    points.push_back(curve.Evaluate(parameters.back()));
  }
  const std::vector<double> found = MaWeights(points, parameters, basis);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(found[k] / found[0], weights[k] / weights[0], 0.02) << k;
  for (const double w : MaWeights(WithNoise(points, 0.3, 1, false), parameters, basis)) EXPECT_GE(w, 0.05);
  const NurbsCurve fitted = FitCurveAtParameters(points, parameters, basis, 0, weights);
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_NEAR((fitted.control_points()[k] - control_points[k]).norm(), 0, 1e-10);
  }
}

}  // namespace
}  // namespace frond
