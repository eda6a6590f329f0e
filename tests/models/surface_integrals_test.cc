// SPDX-License-Identifier: BSD-3-Clause
#include "models/surface_integrals.h"

#include <gtest/gtest.h>

#include <chrono>

#include "models/nurbs_operations.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

double PolygonArea(const TrimLoop& loop) {
  double twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2d &a = loop[k], &b = loop[(k + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

TEST(Area, OfSphereCylinderTorus_IsExact) {
  EXPECT_NEAR(Area({ExactSphere(3), {}}) / (36 * kPi), 1, 1e-9);
  EXPECT_NEAR(Area({ExactCylinder(2, 5), {}}) / (20 * kPi), 1, 1e-9);
  EXPECT_NEAR(Area({ExactTorus(5, 2), {}}) / (40 * kPi * kPi), 1, 1e-9);
}

TEST(Area, OfPlaneTrimmedByADisc_IsThePolygons) {
  for (const int count : {4, 20}) {
    const TrimLoop disc = RegularLoop({0.47, 0.52}, 0.41, 1000);
    EXPECT_NEAR(Area({PlaneSurface(3, count, 4, 3), {disc}}) / (12 * PolygonArea(disc)), 1, 1e-12);
    EXPECT_NEAR(Area({PlaneSurface(3, count, 4, 3), {disc}}) / (12 * kPi * 0.41 * 0.41), 1, 1e-5);
  }
}

TEST(Area, WithHoles_LeavesThemOut) {
  Random random(51);
  const TrimLoop outer = ToothedLoop({0.5, 0.5}, 0.48, 300, random),
                 hole = ToothedLoop({0.5, 0.55}, 0.2, 70, random);
  EXPECT_NEAR(Area({PlaneSurface(2, 9), {outer, hole}}), PolygonArea(outer) - PolygonArea(hole), 1e-13);
}

TEST(Area, OfASphericalCap_MatchesItsFormula) {
  // The cap of the sphere above z = 0 by a loop along the domain's edges: half of the sphere.
  const TrimLoop half = {{0, 0.5}, {1, 0.5}, {1, 1}, {0, 1}};
  EXPECT_NEAR(Area({ExactSphere(3), {half}}) / (18 * kPi), 1, 1e-9);
}

TEST(Area, OfTrimmedCurvedSurface_MatchesItsParts) {
  Random random(52);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 12), UniformBasis(3, 10), random, 0.03);
  const double split = 0.4321;
  const double below = Area({Part(s, Direction::kV, 0, split), {}});
  EXPECT_NEAR(Area({s, {{{0, 0}, {1, 0}, {1, split}, {0, split}}}}) / below, 1, 1e-6);
  const double whole = Area({s, {}});
  const TrimLoop star = ToothedLoop({0.5, 0.5}, 0.45, 400, random);
  const TrimLoop square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_NEAR((Area({s, {star}}) + Area({s, {square, star}})) / whole, 1, 1e-6);
}

TEST(Area, UnderAMotion_StaysTheSame) {
  Random random(53);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 12), UniformBasis(3, 10), random);
  const TrimLoop star = ToothedLoop({0.5, 0.5}, 0.45, 400, random);
  Eigen::Isometry3d motion =
      Eigen::Translation3d(3, -2, 9) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized());
  EXPECT_NEAR(Area({Transformed(s, motion), {star}}) / Area({s, {star}}), 1, 1e-12);
}

TEST(Area, Of20By20BicubicWith1000Corners_TakesMilliseconds) {
  Random random(54);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 20), UniformBasis(3, 20), random);
  const TrimmedSurface trimmed{s, {ToothedLoop({0.5, 0.5}, 0.48, 1000, random)}};
  const auto start = std::chrono::steady_clock::now();
  const double area = Area(trimmed);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  RecordProperty("milliseconds", std::to_string(elapsed.count()));
  std::printf("  area with 1000 corners: %.1f ms\n", elapsed.count());
  EXPECT_GT(area, 0);
  EXPECT_EQ(area, Area(trimmed));
}

TEST(ArcLength, OfACircle_IsItsCircumference) {
  EXPECT_NEAR(ArcLength(ExactCircle(2)) / (4 * kPi), 1, 1e-12);
  EXPECT_NEAR(ArcLength(ExactCircle(2), 0.25, 0.75) / (2 * kPi), 1, 1e-12);
}

TEST(ArcLength, OfACurveWithACusp_IsFound) {
  // (t², t³)-like cusp inside a span: C = (s², s³), s = t − 0.3 on [0, 1].
  const NurbsCurve curve(
      UniformBasis(3, 4),
      {{0.09, -0.027, 0}, {-0.11, 0.063, 0}, {0.0233333333333333, -0.147, 0}, {0.49, 0.343, 0}});
  const auto length = [](double s) { return (std::pow(4 + 9 * s * s, 1.5) - 8) / 27; };
  EXPECT_NEAR(ArcLength(curve), length(0.3) + length(0.7), 1e-9);
}

}  // namespace
}  // namespace frond
