// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/surface_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "models/knot_vector.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// x = v, y = u over [0, 2] × [0, 3] in the plane z = 0: S_u × S_v looks to −z. 12 × 12 control points.
NurbsSurface Plane() {
  const BSplineBasis u = UniformBasis(1, 12, 0, 2), v = UniformBasis(1, 12, 0, 3);
  Points control_points;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) control_points.emplace_back(3.0 * j / 11, 2.0 * i / 11, 0);
  }
  return NurbsSurface(u, v, control_points);
}

// A jittered grid over the plane's rectangle, `side`² points, at height z.
Points Sheet(int side, double z) {
  Points points;
  for (const auto& p : JitteredSquare(side, 5)) points.emplace_back(3 * p.x(), 2 * p.y(), z);
  return points;
}

SurfaceQuality Judge(const Points& points, const TrimmedSurface& surface, double spacing,
                     const std::vector<std::uint8_t>& outlier = {}) {
  const KdTree tree(points);
  return JudgeSurface(points, outlier, MeasureDistances(points, surface.surface, 1), surface,
                      {.spacing = spacing}, tree, 1);
}

TEST(MeasureDistances, FromAPlane_AreSignedHeightsAndFeetBelowThePoints) {
  const NurbsSurface plane = Plane();
  const Points points{{1, 1, 0.25}, {2, 0.5, -0.125}, {0.3, 1.7, 0}};
  const PointDistances distances = MeasureDistances(points, plane, 1);
  EXPECT_NEAR(distances.signed_distance[0], -0.25, 1e-12);  // the normal looks down
  EXPECT_NEAR(distances.signed_distance[1], 0.125, 1e-12);
  EXPECT_NEAR(distances.signed_distance[2], 0, 1e-12);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(plane.Evaluate(distances.feet[i][0], distances.feet[i][1])
                    .isApprox(Eigen::Vector3d(points[i].x(), points[i].y(), 0), 1e-6));
  }
}

TEST(MeasureDistances, OfPointsBeyondTheEdge_AreToTheEdge) {
  const PointDistances distances = MeasureDistances(Points{{-3, 1, 4}, {6, 6, 0}}, Plane(), 1);
  EXPECT_NEAR(std::abs(distances.signed_distance[0]), 5, 1e-9);
  EXPECT_NEAR(std::abs(distances.signed_distance[1]), 5, 1e-9);
}

TEST(MeasureDistances, OnTwoThreads_AreTheSameBytes) {
  const NurbsSurface surface = MakeSurface({});
  const auto points = PointsAround(surface, 3000, 1, 300, 3);
  const PointDistances one = MeasureDistances(points, surface, 1), two = MeasureDistances(points, surface, 2);
  EXPECT_EQ(one.signed_distance, two.signed_distance);
  EXPECT_EQ(one.feet, two.feet);
}

TEST(JudgeSurface, PlaneAgainstAShiftedCloud_SeesTheShiftBothWays) {
  const SurfaceQuality quality = Judge(Sheet(150, 0.1), {Plane(), {}}, 0.02);
  EXPECT_NEAR(quality.rmse, 0.1, 1e-12);
  EXPECT_NEAR(quality.mean, 0.1, 1e-12);
  EXPECT_NEAR(quality.max, 0.1, 1e-12);
  EXPECT_NEAR(quality.p95, 0.1, 1e-12);
  EXPECT_GE(quality.reverse_p95, 0.1);
  EXPECT_LE(quality.reverse_max, std::hypot(0.1, 0.04));
  EXPECT_NEAR(quality.area, 6, 1e-9);
  EXPECT_EQ(quality.flipped_normals, 0);
  EXPECT_EQ(quality.data_coverage, 0);  // no point within 0.06
}

TEST(JudgeSurface, Percentiles_AreThoseOfTheSortedDistances) {
  Points points;
  for (int i = 0; i <= 100; ++i) points.emplace_back(1.5, 1, 0.01 * ((i * 37) % 101));
  const SurfaceQuality quality = Judge(points, {Plane(), {}}, 10);
  EXPECT_NEAR(quality.p95, 0.95, 1e-12);
  EXPECT_NEAR(quality.max, 1, 1e-12);
  EXPECT_NEAR(quality.mean, 0.5, 1e-12);
  EXPECT_NEAR(quality.rmse, std::sqrt(0.335), 1e-12);  // Σ i² = 338,350 over 101 · 100²
}

TEST(JudgeSurface, Outliers_CountInTheDistancesButNotAsData) {
  Points points = Sheet(100, 0);
  points.emplace_back(1, 1, 5);
  std::vector<std::uint8_t> outlier(points.size(), 0);
  outlier.back() = 1;
  const SurfaceQuality quality = Judge(points, {Plane(), {}}, 0.03, outlier);
  EXPECT_NEAR(quality.max, 5, 1e-9);
  EXPECT_LT(quality.inlier_max, 1e-9);
  EXPECT_LT(quality.inlier_rmse, 1e-9);
  EXPECT_NEAR(quality.rmse, 5 / std::sqrt(10001.0), 1e-9);
  EXPECT_EQ(quality.data_coverage, 1);
}

TEST(JudgeSurface, CoverageWithAHole_IsTheShareOutsideIt) {
  Points points = Sheet(150, 0);
  const Eigen::Vector3d centre(1.5, 1, 0);
  constexpr double kHole = 0.5, kSpacing = 0.016;
  std::erase_if(points, [&](const Eigen::Vector3d& p) { return (p - centre).norm() < kHole; });
  const SurfaceQuality quality = Judge(points, {Plane(), {}}, kSpacing);
  const double reached = kHole - 3 * kSpacing;
  EXPECT_NEAR(quality.data_coverage, 1 - M_PI * reached * reached / 6, 0.005);
  EXPECT_NEAR(quality.reverse_max, kHole, 0.03);
  EXPECT_LT(quality.max, 1e-9);  // the cloud alone does not see it
}

TEST(JudgeSurface, TrimmedPart_DoesNotCount) {
  const TrimmedSurface half{Plane(), {{{0, 0}, {2, 0}, {2, 1.5}, {0, 1.5}}}};
  Points points = Sheet(150, 0);
  std::erase_if(points, [](const Eigen::Vector3d& p) { return p.x() > 1.5; });
  const SurfaceQuality quality = Judge(points, half, 0.02);
  EXPECT_NEAR(quality.area, 3, 1e-6);
  EXPECT_NEAR(quality.surface_samples, 20000, 200);
  EXPECT_EQ(quality.data_coverage, 1);
  EXPECT_NEAR(Judge(points, {Plane(), {}}, 0.02).data_coverage, 0.5 + 0.06 / 3, 0.01);
}

TEST(JudgeSurface, FoldedSurface_HasFlippedNormals) {
  const NurbsSurface plane = Plane();
  Points control_points = plane.control_points();
  // A column in the middle pulled back over its neighbour: the strip between the two runs backwards.
  for (std::size_t i = 0; i < 12; ++i) std::swap(control_points[i * 12 + 5], control_points[i * 12 + 6]);
  const TrimmedSurface folded{NurbsSurface(plane.u(), plane.v(), control_points), {}};
  const Points points = Sheet(150, 0);
  EXPECT_EQ(Judge(points, {plane, {}}, 0.02).flipped_normals, 0);
  const SurfaceQuality quality = Judge(points, folded, 0.02);
  EXPECT_GT(quality.flipped_normals, 0);
  EXPECT_LT(quality.max, 1e-9);                    // distance alone is cheated
  EXPECT_NEAR(quality.area, 6 + 12.0 / 11, 1e-6);  // three times the strip and its two neighbours' excess
}

TEST(JudgeSurface, SheetFoldedInHalf_HasHalfItsNormalsFlipped) {
  // x = (u − ½)²: back over itself along a crease in the middle.
  const BSplineBasis u = UniformBasis(2, 3), v = UniformBasis(1, 2);
  Points control_points;
  for (const double x : {0.25, -0.25, 0.25}) {
    for (int j = 0; j < 2; ++j) control_points.emplace_back(x, j, 0);
  }
  const TrimmedSurface folded{NurbsSurface(u, v, control_points), {}};
  const SurfaceQuality quality = Judge(Sheet(30, 0), folded, 0.1);
  EXPECT_NEAR(quality.flipped_normals, 0.5 * quality.surface_samples, 0.01 * quality.surface_samples);
}

TEST(JudgeSurface, CurledSheet_HasNoFlippedNormals) {
  // Four fifths of a cylinder: normals turn by 288° over the sheet, but not against their surroundings.
  const BSplineBasis u = UniformBasis(3, 16), v = UniformBasis(1, 2);
  Points control_points;
  for (int i = 0; i < 16; ++i) {
    const double a = 0.8 * 2 * M_PI * i / 15;
    for (int j = 0; j < 2; ++j) control_points.emplace_back(5.0 * j, std::cos(a), std::sin(a));
  }
  const TrimmedSurface curled{NurbsSurface(u, v, control_points), {}};
  EXPECT_EQ(Judge(Sheet(30, 0), curled, 0.1).flipped_normals, 0);
}

TEST(JudgeSurface, OfNoPoints_IsAllZero) {
  const SurfaceQuality quality = Judge({}, {Plane(), {}}, 1);
  EXPECT_EQ(quality.rmse, 0);
  EXPECT_EQ(quality.surface_samples, 0);
}

}  // namespace
}  // namespace frond
