// SPDX-License-Identifier: BSD-3-Clause
// Whole fits of synthetic leaves against their truth: the table of issue 2, on two of bench_accuracy's eight
// leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

constexpr double kNoise = 0.05;

class SurfaceFitOnLeaves : public testing::TestWithParam<int> {};

TEST_P(SurfaceFitOnLeaves, At20By20_IsAccurateAndCheatsNowhere) {
  const LeafCase leaf = MakeLeafCase(static_cast<std::uint64_t>(GetParam()), {.noise = kNoise});
  const SurfaceFit fit = FitLeaf(leaf.points, {});
  const TruthErrors errors = ErrorsAgainst(leaf.dense_clean, fit.surface.surface);
  EXPECT_LE(errors.rmse, 0.015);
  EXPECT_LE(fit.quality.max, 6 * kNoise + errors.max);  // no foot left behind
  EXPECT_NEAR(fit.quality.area, leaf.scan.measures.area, 0.006 * leaf.scan.measures.area);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_GE(fit.quality.data_coverage, 0.999);
  EXPECT_EQ(fit.margin, MarginMode::kTrim);
  EXPECT_EQ(fit.surface.trim.size(), 1U);
  EXPECT_TRUE(fit.warnings.empty());
  // Sound points are not lost: at most one in a thousand.
  EXPECT_LE(std::count(fit.outlier.begin(), fit.outlier.end(), 1), 40);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfaceFitOnLeaves, ::testing::Range(1, 9));  // a hill; the wildest

TEST(SurfaceFit, WithOutliers_FindsThemAndFitsTheRest) {
  const LeafCase leaf = MakeLeafCase(2, {.points = 20000, .noise = kNoise, .outlier_share = 0.02});
  const SurfaceFit fit = FitLeaf(leaf.points, {});
  int thrown = 0, found = 0, false_alarms = 0;
  for (std::size_t i = 0; i < leaf.points.size(); ++i) {
    const bool outlier = leaf.scan.kinds[i] == ScanPointKind::kOutlier;
    // Thrown sideways along the sheet, a point may have landed on it: no one can tell.
    const bool on_the_sheet = std::abs(fit.distances.signed_distance[i]) < 6 * kNoise;
    thrown += outlier && !on_the_sheet;
    found += outlier && !on_the_sheet && fit.outlier[i];
    false_alarms += !outlier && fit.outlier[i];
  }
  EXPECT_GE(thrown, 300);
  EXPECT_GE(found, 0.97 * thrown);
  EXPECT_LE(false_alarms, 0.03 * thrown);
  EXPECT_LE(ErrorsAgainst(leaf.dense_clean, fit.surface.surface).rmse, 0.02);
  EXPECT_LE(fit.quality.inlier_max, 10 * kNoise);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_NEAR(fit.quality.area, leaf.scan.measures.area, 0.01 * leaf.scan.measures.area);
}

TEST(SurfaceFit, WithHoles_IsCarriedOverThemAndReportsThem) {
  const LeafCase leaf = MakeLeafCase(2, {.points = 20000, .noise = kNoise, .holes = 3, .hole_radius = 3});
  const SurfaceFit fit = FitLeaf(leaf.points, {});
  std::vector<Eigen::Vector3d> scanned, holes;
  for (std::size_t i = 0; i < leaf.dense_clean.size(); ++i) {
    (leaf.scan.dense_scanned[i] ? scanned : holes).push_back(leaf.dense_clean[i]);
  }
  EXPECT_LE(ErrorsAgainst(scanned, fit.surface.surface).rmse, 0.02);
  EXPECT_LE(ErrorsAgainst(holes, fit.surface.surface).rmse, 0.4);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  const double missing = 1 - leaf.scan.scanned_area / leaf.scan.measures.area;
  EXPECT_GT(missing, 0.02);
  EXPECT_LT(fit.quality.data_coverage, 1 - 0.4 * missing);  // a rim of three spacings counts as covered
  EXPECT_GT(fit.quality.data_coverage, 1 - missing - 0.01);
}

TEST(SurfaceFit, WithFreeWeights_IsNoWorse) {
  const LeafCase leaf = MakeLeafCase(2, {.points = 10000, .noise = kNoise});
  SurfaceFitOptions options;
  options.control_points = {12, 12};
  const double points_alone =
      ErrorsAgainst(leaf.dense_clean, FitLeaf(leaf.points, options).surface.surface).rmse;
  options.unknowns = SurfaceUnknowns::kBoth;
  const SurfaceFit fit = FitLeaf(leaf.points, options);
  EXPECT_LE(ErrorsAgainst(leaf.dense_clean, fit.surface.surface).rmse, 1.1 * points_alone);
  EXPECT_TRUE(fit.surface.surface.IsRational());
  for (const double weight : fit.surface.surface.weights()) EXPECT_TRUE(weight > 0.2 && weight < 5) << weight;
  EXPECT_EQ(fit.quality.flipped_normals, 0);
}

TEST(SurfaceFit, ConformingAt5By5_FollowsTheOutline) {
  const LeafCase leaf = MakeLeafCase(2, {.points = 10000, .noise = kNoise});
  SurfaceFitOptions options;
  options.control_points = {5, 5};
  options.tie_tip = true;
  const SurfaceFit fit = FitLeaf(leaf.points, options);
  EXPECT_EQ(fit.margin, MarginMode::kConforming);
  EXPECT_TRUE(fit.surface.trim.empty());
  EXPECT_LE(ErrorsAgainst(leaf.dense_clean, fit.surface.surface).rmse, 0.3);
  EXPECT_NEAR(fit.quality.area, leaf.scan.measures.area, 0.025 * leaf.scan.measures.area);
  EXPECT_LE(fit.quality.flipped_normals, 0.002 * fit.quality.surface_samples);
  const NurbsSurface& surface = fit.surface.surface;
  for (int i = 1; i < 5; ++i) EXPECT_EQ(surface.control_point(i, 4), surface.control_point(0, 4));
}

TEST(SurfaceFit, AutoNet_IsFineEnoughForTheLeafAndNotMore) {
  const LeafCase leaf = MakeLeafCase(2, {.points = 4000, .noise = kNoise});
  SurfaceFitOptions options;
  options.control_points = {0, 0};
  const SurfaceFit fit = FitLeaf(leaf.points, options);
  EXPECT_GE(fit.control_points[0], 7);
  EXPECT_LE(fit.control_points[0], 20);
  EXPECT_EQ(fit.surface.surface.count_u(), fit.control_points[0]);
  EXPECT_EQ(fit.surface.surface.count_v(), fit.control_points[1]);
  EXPECT_LE(ErrorsAgainst(leaf.dense_clean, fit.surface.surface).rmse, 0.04);
}

}  // namespace
}  // namespace frond
