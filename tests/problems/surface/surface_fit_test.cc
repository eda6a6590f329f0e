// SPDX-License-Identifier: BSD-3-Clause
// What a sheet fit must not depend on, and what it refuses.
#include "problems/surface/surface_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "base/random.h"
#include "problems/leaf/leaf_frame.h"
#include "problems/surface/outliers.h"
#include "tests/problems/surface/leaf_case.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// One scan and its fit that all invariance tests compare with.
struct Standard {
  LeafCase leaf = MakeLeafCase(3, {.points = 6000, .outlier_share = 0.01, .dense_points = 1000});
  SurfaceFitOptions options = [] {
    SurfaceFitOptions some;
    some.control_points = {12, 14};
    some.subset = 2000;
    return some;
  }();
  SurfaceFit fit = FitLeaf(leaf.points, options);
  double size = fit.surface.surface.Size();
};

const Standard& TheStandard() {
  static const Standard standard;
  return standard;
}

Points InLeafFrame(const Points& points) {
  const LeafFrame frame = FindLeafFrame(points);
  Points moved;
  for (const auto& point : points) moved.push_back(frame.FromInput(point));
  return moved;
}

void ExpectSameDistances(const SurfaceFit& fit, const SurfaceFit& standard, double unit) {
  const double tolerance = 1e-6 * TheStandard().size;
  ASSERT_EQ(fit.outlier, standard.outlier);
  for (std::size_t i = 0; i < fit.outlier.size(); ++i) {
    ASSERT_NEAR(std::abs(fit.distances.signed_distance[i]) / unit,
                std::abs(standard.distances.signed_distance[i]), tolerance)
        << i;
  }
  EXPECT_NEAR(fit.quality.area / (unit * unit), standard.quality.area, 1e-5 * standard.quality.area);
  EXPECT_NEAR(fit.quality.rmse / unit, standard.quality.rmse, tolerance);
}

TEST(SurfaceFitInvariance, RigidMotion_ChangesNoDistance) {
  const Standard& standard = TheStandard();
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(120, -45, 300) * Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized());
  Points moved;
  for (const auto& point : standard.leaf.scan.points) moved.push_back(motion * point);
  ExpectSameDistances(FitLeaf(InLeafFrame(moved), standard.options), standard.fit, 1);
}

TEST(SurfaceFitInvariance, MetresInsteadOfMillimetres_ChangeNoDistance) {
  const Standard& standard = TheStandard();
  Points metres;
  for (const auto& point : standard.leaf.points) metres.push_back(1e-3 * point);
  ExpectSameDistances(FitLeaf(metres, standard.options), standard.fit, 1e-3);
}

TEST(SurfaceFitInvariance, PointOrder_ChangesNoDistance) {
  const Standard& standard = TheStandard();
  std::vector<std::size_t> order(standard.leaf.points.size());
  std::iota(order.begin(), order.end(), 0U);
  Random random(3);
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random.Below(i + 1)]);
  Points shuffled;
  for (const auto i : order) shuffled.push_back(standard.leaf.points[i]);
  const SurfaceFit fit = FitLeaf(shuffled, standard.options);
  SurfaceFit back = fit;
  for (std::size_t k = 0; k < order.size(); ++k) {
    back.outlier[order[k]] = fit.outlier[k];
    back.distances.signed_distance[order[k]] = fit.distances.signed_distance[k];
  }
  ExpectSameDistances(back, standard.fit, 1);
}

TEST(SurfaceFitInvariance, ThreadCount_ChangesNotAByte) {
  const Standard& standard = TheStandard();
  const SurfaceFit two = FitLeaf(standard.leaf.points, standard.options, 2);
  EXPECT_EQ(two.surface.surface.control_points(), standard.fit.surface.surface.control_points());
  EXPECT_EQ(two.surface.trim, standard.fit.surface.trim);
  EXPECT_EQ(two.outlier, standard.fit.outlier);
  EXPECT_EQ(two.distances.signed_distance, standard.fit.distances.signed_distance);
  EXPECT_EQ(two.distances.feet, standard.fit.distances.feet);
  EXPECT_EQ(two.quality.area, standard.fit.quality.area);
  EXPECT_EQ(two.quality.rmse, standard.fit.quality.rmse);
  EXPECT_EQ(two.quality.data_coverage, standard.fit.quality.data_coverage);
  EXPECT_EQ(two.report.objective, standard.fit.report.objective);
}

TEST(SurfaceFit, Report_CountsAllStages) {
  const SurfaceFit& fit = TheStandard().fit;
  EXPECT_NE(fit.report.termination, Termination::kFailed);
  EXPECT_GT(fit.report.iterations, 3);
  ASSERT_GT(fit.report.trace.size(), 3U);
  for (std::size_t k = 1; k < fit.report.trace.size(); ++k) {
    EXPECT_GE(fit.report.trace[k].evaluations, fit.report.trace[k - 1].evaluations);
    EXPECT_GE(fit.report.trace[k].seconds, fit.report.trace[k - 1].seconds);
  }
  std::vector<std::string> names;
  for (const StageTime& stage : fit.stages) names.push_back(stage.name);
  EXPECT_EQ(names, (std::vector<std::string>{"points", "fit", "distances", "trim", "quality"}));
}

TEST(SurfaceFit, Budget_IsHeldOverAllStages) {
  const Standard& standard = TheStandard();
  Budget budget;
  budget.max_evaluations = standard.fit.report.evaluations / 3;
  const SurfaceFit fit = FitSurface(standard.leaf.points, StrayPoints(standard.leaf.points), std::nullopt,
                                    standard.options, *SheetSolver(standard.options), budget, {});
  EXPECT_EQ(fit.report.termination, Termination::kEvaluationBudget);
  // A stage's start and last step are counted whole.
  EXPECT_LT(fit.report.evaluations, standard.fit.report.evaluations);
}

TEST(SurfaceFit, FromAGivenStart_KeepsItsFrameAndImprovesIt) {
  const Standard& standard = TheStandard();
  SurfaceFitOptions coarse = standard.options;
  coarse.control_points = {6, 8};
  coarse.margin = MarginMode::kTrim;
  const SurfaceFit start = FitLeaf(standard.leaf.points, coarse);
  const SurfaceFit fit =
      FitSurface(standard.leaf.points, StrayPoints(standard.leaf.points), start.surface.surface,
                 standard.options, *SheetSolver(standard.options), {}, {});
  EXPECT_LT(fit.quality.inlier_rmse, start.quality.inlier_rmse);
  EXPECT_LT(fit.quality.inlier_rmse, 1.05 * standard.fit.quality.inlier_rmse);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
}

TEST(SurfaceFit, RobustLoss_HoldsAgainstOutliersThatAreKept) {
  const Standard& standard = TheStandard();
  SurfaceFitOptions options = standard.options;
  options.outlier_threshold = 0;
  options.loss = "tukey";
  const SurfaceFit fit = FitLeaf(standard.leaf.points, options);
  EXPECT_EQ(std::count(fit.outlier.begin(), fit.outlier.end(), 1), 0);
  EXPECT_LE(ErrorsAgainst(standard.leaf.clean_points, fit.surface.surface).rmse, 0.05);
}

SurfaceFit FitPoints(const Points& points, std::array<int, 2> net = {20, 20}) {
  SurfaceFitOptions options;
  options.control_points = net;
  return FitLeaf(points, options);
}

TEST(SurfaceFitErrors, CollinearPoints_HaveNoArea) {
  Points line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(i, 0, 0);
  EXPECT_THROW(FitPoints(line, {4, 4}), InputError);
}

TEST(SurfaceFitErrors, NoOneOrEqualPoints_HaveNoArea) {
  EXPECT_THROW(FitPoints({}), InputError);
  EXPECT_THROW(FitPoints({{1, 2, 3}}), InputError);
  EXPECT_THROW(FitPoints(Points(500, Eigen::Vector3d(1, 2, 3)), {4, 4}), InputError);
}

TEST(SurfaceFitErrors, FewerPointsThanControlPoints_SaysHowManyCan) {
  Points points;
  for (const auto& p : JitteredSquare(10, 1)) points.emplace_back(10 * p.x(), 10 * p.y(), 0);
  try {
    FitPoints(points);
    FAIL() << "100 points, 400 control points";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 10 x 10"), std::string::npos) << error.what();
  }
}

TEST(SurfaceFitErrors, PlaneOfTenPoints_IsTooFewForTheDefaultAndEnoughForAPatch) {
  Points points;
  for (int i = 0; i < 10; ++i) points.emplace_back(i % 4, i / 4, 0);
  EXPECT_THROW(FitPoints(points), InputError);
}

}  // namespace
}  // namespace frond
