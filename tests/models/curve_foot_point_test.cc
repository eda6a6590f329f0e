// SPDX-License-Identifier: BSD-3-Clause
#include "models/curve_foot_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "models/knot_vector.h"

namespace frond {
namespace {

// A circle of radius 2 in four quarters, the textbook's nine control points.
NurbsCurve Circle() {
  const double h = std::sqrt(0.5);
  return NurbsCurve(BSplineBasis(2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}),
                    {{2, 0, 0},
                     {2, 2, 0},
                     {0, 2, 0},
                     {-2, 2, 0},
                     {-2, 0, 0},
                     {-2, -2, 0},
                     {0, -2, 0},
                     {2, -2, 0},
                     {2, 0, 0}},
                    {1, h, 1, h, 1, h, 1, h, 1});
}

// A closed cubic in space, wound so that it comes near itself.
NurbsCurve Wound() {
  const BSplineBasis basis = PeriodicUniformBasis(3, 14);
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 14; ++k) points.emplace_back(random.Normal(), random.Normal(), random.Normal());
  for (std::size_t k = 0; k < 3; ++k) points.push_back(points[k]);
  return NurbsCurve(basis, points);
}

TEST(CurveSpans, Values_AreThoseOfTheCurve) {
  for (const NurbsCurve& curve : {Circle(), Wound()}) {
    const CurveSpans spans(curve);
    for (double t = 0; t < 1; t += 0.0137) {
      const CurvePoint fast = spans.EvaluateWithDerivatives(t), slow = curve.EvaluateWithDerivatives(t);
      EXPECT_NEAR((fast.position - slow.position).norm(), 0, 1e-13);
      EXPECT_NEAR((fast.d1 - slow.d1).norm(), 0, 1e-11);
      EXPECT_NEAR((fast.d2 - slow.d2).norm(), 0, 1e-9);
    }
  }
}

TEST(CurveIntegrals, OfACircle_AreItsCircumferenceAndCentre) {
  const CurveIntegrals integrals = IntegrateCurve(CurveSpans(Circle()));
  EXPECT_NEAR(integrals.length, 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(integrals.barycentre.norm(), 0, 1e-12);
}

TEST(CurveFootPoint, OnACircle_IsTheRadialProjection) {
  const CurveSpans spans(Circle());
  const CurveFootSearch search(spans);
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d point(3 * random.Normal(), 3 * random.Normal(), random.Normal());
    const double radial = std::hypot(point.x(), point.y()) - 2;
    EXPECT_NEAR(std::sqrt(search.Find(point).squared_distance), std::hypot(radial, point.z()), 1e-12);
  }
}

TEST(CurveFootPoint, BySearch_IsAsNearAsByBruteForce) {
  const CurveSpans spans(Wound());
  const CurveFootSearch search(spans);
  const std::vector<Eigen::Vector3d> polyline = CurvePolyline(spans, 2000);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d point(2 * random.Normal(), 2 * random.Normal(), 2 * random.Normal());
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& sample : polyline) nearest = std::min(nearest, (sample - point).norm());
    const CurveFoot foot = search.Find(point);
    EXPECT_LE(std::sqrt(foot.squared_distance), nearest + 1e-12);
    const CurvePoint c = spans.EvaluateWithDerivatives(foot.t);
    EXPECT_NEAR((c.position - point).dot(c.d1.normalized()), 0, 1e-7);
    EXPECT_FALSE(foot.at_end);
  }
}

TEST(CurveFootPoint, BeyondAnOpenEnd_IsTheEnd) {
  const NurbsCurve segment(UniformBasis(1, 2), {{0, 0, 0}, {1, 0, 0}});
  const CurveSpans spans(segment);
  const CurveFootSearch search(spans);
  const CurveFoot before = search.Find({-1, 1, 0}), beside = search.Find({0.25, 1, 0});
  EXPECT_EQ(before.t, 0);
  EXPECT_TRUE(before.at_end);
  EXPECT_NEAR(beside.t, 0.25, 1e-12);
  EXPECT_FALSE(beside.at_end);
}

TEST(PeriodicBasis, OfDoubleKnots_RepeatsAndHoldsACircle) {
  const std::vector<double> knots = {0, 0, 1.0 / 3, 1.0 / 3, 2.0 / 3, 2.0 / 3};
  const BSplineBasis basis = PeriodicBasis(2, knots);
  EXPECT_TRUE(basis.periodic());
  EXPECT_EQ(basis.num_distinct_control_points(), 6);
  EXPECT_EQ(basis.spans().size(), 3U);
  EXPECT_EQ(basis.begin(), 0);
  EXPECT_EQ(basis.end(), 1);
  // Three arcs of 120°: corners at radius 2 and on the circle in turn, the corners' weight cos 60°. Where the
  // domain begins a knot is double, so the function of that corner is the second.
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi / 3 * k, radius = k % 2 == 0 ? 2 : 1;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    weights.push_back(k % 2 == 0 ? 0.5 : 1);
  }
  const NurbsCurve curve(basis, points, weights);
  for (double t = 0; t < 1; t += 0.01) EXPECT_NEAR(curve.Evaluate(t).norm(), 1, 1e-14) << t;
}

TEST(ParametriseClosed, Square_HasItsCornersAtQuarters) {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(ParametriseClosed(square, Parametrisation::kChord), (std::vector<double>{0, 0.25, 0.5, 0.75}));
}

}  // namespace
}  // namespace frond
