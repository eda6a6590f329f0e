// SPDX-License-Identifier: BSD-3-Clause
// The distance fit as a function of its parameters: its gradient is that of the true cost, feet moved along
// (the envelope theorem), and a solve has the same bytes on any number of threads.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "models/foot_point_search.h"
#include "problems/surface/distance_fit.h"
#include "solvers/solver.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

std::vector<double> GradientAtStart(const SurfaceDistanceFit& fit) {
  LeastSquares least_squares(fit, 1);
  std::vector<double> gradient;
  double cost = 0;
  EXPECT_TRUE(least_squares.problem().Evaluate({}, &cost, nullptr, &gradient, nullptr));
  return gradient;
}

// By central differences of the cost, in the order of the free parameters.
void ExpectGradientOfTrueCost(const WavySheet& sheet, const DistanceFitOptions& options, int beyond) {
  const NurbsSurface start = MakeSurface(sheet);
  const auto points = PointsAround(start, 300, 0.3, beyond, 8);
  WavySheet other = sheet;
  other.seed += 1;
  const SurfaceDistanceFit fit(points, start, MakeSurface(other), options, 1);
  const std::vector<double> gradient = GradientAtStart(fit);
  double largest = 0;
  for (const double g : gradient) largest = std::max(largest, std::abs(g));
  std::size_t free =
      0;  // a value held by a manifold has no place in the gradient, one of a constant block a zero
  const bool weights_alone = options.unknowns == SurfaceUnknowns::kWeights;
  std::vector<double> x = fit.StartVector();
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (options.unknowns == SurfaceUnknowns::kBoth && k == 3) continue;
    if (weights_alone && k == 0) {
      EXPECT_EQ(gradient[free++], 0);
      continue;
    }
    const double x0 = x[k], step = 2e-5;
    x[k] = x0 + step;
    const double above = fit.Objective(x);
    x[k] = x0 - step;
    const double below = fit.Objective(x);
    x[k] = x0;
    ASSERT_NEAR(gradient[free], (above - below) / (2 * step), 2e-6 * largest) << "parameter " << k;
    ++free;
  }
  EXPECT_EQ(free, gradient.size());
}

constexpr WavySheet kSmall{.count_u = 5, .count_v = 5, .uneven_knots = true};
constexpr WavySheet kSmallRational{.count_u = 5, .count_v = 5, .uneven_knots = true, .rational = true};

DistanceFitOptions PointsAlone() {
  DistanceFitOptions options;
  options.fairness = options.hinge = options.weight_ridge = 0;
  return options;
}

TEST(DistanceFitGradient, FeetInside_IsThatOfTheTrueCost) {
  ExpectGradientOfTrueCost(kSmall, PointsAlone(), 0);
}

TEST(DistanceFitGradient, FeetOnEdgesAndInCorners_IsThatOfTheTrueCost) {
  ExpectGradientOfTrueCost(kSmall, PointsAlone(), 200);
}

TEST(DistanceFitGradient, WithFairnessAndActiveHinge_IsThatOfTheTrueCost) {
  DistanceFitOptions options;
  options.fairness = 1e-5;
  options.hinge = 2;
  options.hinge_limit = 0.95;
  ExpectGradientOfTrueCost(kSmall, options, 60);
}

TEST(DistanceFitGradient, OverWeights_IsThatOfTheTrueCost) {
  DistanceFitOptions options;
  options.unknowns = SurfaceUnknowns::kWeights;
  options.hinge_limit = 0.95;
  ExpectGradientOfTrueCost(kSmallRational, options, 60);
}

TEST(DistanceFitGradient, OverBothWithRobustLoss_IsThatOfTheTrueCost) {
  DistanceFitOptions options;
  options.unknowns = SurfaceUnknowns::kBoth;
  options.hinge_limit = 0.95;
  options.loss = {RobustLossType::kCauchy, 0.3};
  ExpectGradientOfTrueCost(kSmallRational, options, 60);
}

SolverReport SolveWithLm(const SurfaceDistanceFit& fit, int threads, std::int64_t iterations = 8) {
  const SolverType& type = FindSolverType("lm");
  Options options(type.options);
  options.Set("max_iterations", iterations);
  options.Set("initial_trust_region_radius", 1.0);
  options.Set("linear_solver", std::string("sparse_normal_cholesky"));
  return type.create(options)->Solve(fit, {}, {.threads = threads, .seed = 1});
}

TEST(DistanceFit, OnTwoThreads_GivesTheSameBytesAsOnOne) {
  const NurbsSurface truth = MakeSurface({.count_u = 9, .count_v = 10});
  const auto points = PointsAround(truth, 5000, 0.05, 100, 9);
  const NurbsSurface start = MakeSurface({.count_u = 9, .count_v = 10, .roughness = 0.1});
  for (const auto unknowns : {SurfaceUnknowns::kControlPoints, SurfaceUnknowns::kBoth}) {
    DistanceFitOptions options;
    options.unknowns = unknowns;
    const SolverReport one = SolveWithLm(SurfaceDistanceFit(points, start, start, options, 1), 1);
    const SolverReport two = SolveWithLm(SurfaceDistanceFit(points, start, start, options, 2), 2);
    EXPECT_EQ(one.x, two.x);
    EXPECT_EQ(one.objective, two.objective);
    EXPECT_EQ(one.iterations, two.iterations);
  }
}

TEST(DistanceFit, PointsOfASurface_BringAStartNearItBackToIt) {
  const NurbsSurface truth = MakeSurface({.roughness = 0.25});
  const auto points = PointsAround(truth, 6000, 0, 0, 10);
  std::vector<Eigen::Vector3d> moved = truth.control_points();
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k].z() += 0.3 * std::sin(static_cast<double>(7 * k));
  const NurbsSurface start(truth.u(), truth.v(), moved);
  DistanceFitOptions options;
  options.fairness = 1e-14;
  const SurfaceDistanceFit fit(points, start, start, options, 1);
  const SolverReport report = SolveWithLm(fit, 1, 40);
  const auto before = fit.Metrics(fit.StartVector()), after = fit.Metrics(report.x);
  EXPECT_GT(before.at("rmse"), 0.05);
  EXPECT_LT(after.at("rmse"), 1e-3 * before.at("rmse"));
  EXPECT_LE(after.at("rmse"), after.at("max"));
}

TEST(DistanceFit, Metrics_AreRootMeanSquareAndMaximumOfTheDistances) {
  const NurbsSurface surface = MakeSurface({});
  const auto points = PointsAround(surface, 500, 0.3, 50, 12);
  const SurfaceDistanceFit fit(points, surface, surface, {}, 1);
  const SurfaceCells cells(surface);
  const FootPointSearch search(cells);
  double squared = 0, largest = 0;
  for (const auto& point : points) {
    const double d = search.Find(point, 4).squared_distance;
    squared += d;
    largest = std::max(largest, d);
  }
  const auto metrics = fit.Metrics(fit.StartVector());
  EXPECT_NEAR(metrics.at("rmse"), std::sqrt(squared / 500), 1e-6);
  EXPECT_NEAR(metrics.at("max"), std::sqrt(largest), 1e-6);
}

TEST(DistanceFit, Unit_ScalesTheCostByItsSquare) {
  const NurbsSurface mm = MakeSurface({});
  const auto points_mm = PointsAround(mm, 400, 0.3, 40, 13);
  const double unit = 1e-3;
  std::vector<Eigen::Vector3d> control_points, points;
  for (const auto& p : mm.control_points()) control_points.push_back(unit * p);
  for (const auto& p : points_mm) points.push_back(unit * p);
  const NurbsSurface metres(mm.u(), mm.v(), control_points);
  DistanceFitOptions options;
  options.hinge_limit = 1.1;
  const SurfaceDistanceFit fit_mm(points_mm, mm, mm, options, 1);
  options.length_scale = unit;
  const SurfaceDistanceFit fit_metres(points, metres, metres, options, 1);
  const double cost = fit_mm.Objective(fit_mm.StartVector());
  EXPECT_NEAR(fit_metres.Objective(fit_metres.StartVector()), unit * unit * cost, 1e-9 * unit * unit * cost);
}

}  // namespace
}  // namespace frond
