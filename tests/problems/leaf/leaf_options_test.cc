// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_options.h"

#include <gtest/gtest.h>

#include "base/errors.h"

namespace frond {
namespace {

TEST(LeafOptions, Defaults_AreThoseOfTheSteps) {
  const Options options(LeafSpecs());
  EXPECT_EQ(LeafMethodFrom(options), LeafMethod::kDistance);
  const LeafPaperOptions read = LeafPaperOptionsFrom(options, {2, 2}, {5, 5}), own;
  EXPECT_EQ(read.frame.leave_out_strays, own.frame.leave_out_strays);
  EXPECT_EQ(read.point_set.kind, own.point_set.kind);
  EXPECT_EQ(read.point_set.slices, own.point_set.slices);
  EXPECT_EQ(read.point_set.selected, own.point_set.selected);
  EXPECT_EQ(read.point_set.petiole_width, own.point_set.petiole_width);
  EXPECT_EQ(read.point_set.left, own.point_set.left);
  EXPECT_EQ(read.point_set.right, own.point_set.right);
  EXPECT_EQ(read.point_set.midrib_threshold, own.point_set.midrib_threshold);
  EXPECT_EQ(read.test_subset.slices, own.test_subset.slices);
  EXPECT_EQ(read.test_subset.left, own.test_subset.left);
  EXPECT_EQ(read.surface.algorithm, own.surface.algorithm);
  EXPECT_EQ(read.surface.parametrisation, own.surface.parametrisation);
  EXPECT_EQ(read.surface.count_u, own.surface.count_u);
  EXPECT_EQ(read.free_weights, own.free_weights);
  EXPECT_EQ(read.weights.objective.rmse_share, own.weights.objective.rmse_share);
  EXPECT_EQ(read.weights.lower, own.weights.lower);
  EXPECT_EQ(read.weights.upper, own.weights.upper);
  EXPECT_EQ(read.weights.projection, own.weights.projection);
}

TEST(LeafOptions, EveryWord_IsUnderstood) {
  Options options(LeafSpecs());
  options.Set("method", std::string("paper"));
  options.Set("point_set.kind", std::string("ordered"));
  options.Set("paper.algorithm", std::string("interpolation"));
  options.Set("paper.parametrisation", std::string("centripetal"));
  options.Set("paper.weights", std::string("free"));
  options.Set("paper.projection", std::string("paper"));
  options.Set("paper.weight_bounds", std::vector<double>{0.5, 2});
  EXPECT_EQ(LeafMethodFrom(options), LeafMethod::kPaper);
  const LeafPaperOptions read = LeafPaperOptionsFrom(options, {2, 3}, {3, 7});
  EXPECT_EQ(read.point_set.kind, PointSetKind::kOrdered);
  EXPECT_EQ(read.surface.algorithm, LeafSurfaceAlgorithm::kInterpolation);
  EXPECT_EQ(read.surface.parametrisation, Parametrisation::kCentripetal);
  EXPECT_EQ(read.surface.degree_v, 3);
  EXPECT_EQ(read.surface.count_u, 3);
  EXPECT_EQ(read.surface.count_v, 7);
  EXPECT_TRUE(read.free_weights);
  EXPECT_EQ(read.weights.projection, WeightProjection::kPaper);
  EXPECT_EQ(read.weights.lower, 0.5);
}

TEST(LeafOptions, ValuesThatDoNotFitTogether_AreNamed) {
  Options options(LeafSpecs());
  options.Set("paper.alpha", std::vector<double>{0.8, 0.3});
  try {
    LeafWeightsOptionsFrom(options);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("paper.alpha"), std::string::npos);
  }
}

TEST(SyntheticLeafOptions, Shape_IsTheSeedsButForWhatIsSet) {
  Options options(SyntheticLeafSpecs());
  EXPECT_EQ(ShapeValues(LeafShapeFrom(options, 6)), ShapeValues(RandomLeaf(6)));
  options.Set("character", std::string("wrinkled"));
  options.Set("shape.length", 77.0);
  const LeafShape shape = LeafShapeFrom(options, 6);
  EXPECT_EQ(shape.character, LeafCharacter::kWrinkled);
  EXPECT_EQ(shape.length, 77);
  EXPECT_EQ(shape.width, RandomLeaf(6, LeafCharacter::kWrinkled).width);
}

TEST(SyntheticLeafOptions, Scan_TakesEveryOption) {
  Options options(SyntheticLeafSpecs());
  options.Set("unit", std::string("m"));
  options.Set("noise_direction", std::string("normal"));
  options.Set("outlier_share", 0.1);
  options.Set("outlier_distance", std::vector<double>{3, 9});
  options.Set("pose", std::string("standard"));
  const LeafScanOptions scan = LeafScanOptionsFrom(options, 3);
  EXPECT_EQ(scan.seed, 3u);
  EXPECT_EQ(scan.unit_mm, 1000);
  EXPECT_EQ(scan.noise_direction, NoiseDirection::kNormal);
  EXPECT_EQ(scan.outlier_share, 0.1);
  EXPECT_EQ(scan.outlier_far, 9);
  EXPECT_FALSE(scan.random_pose);
  EXPECT_EQ(scan.points, 40000);
}

}  // namespace
}  // namespace frond
