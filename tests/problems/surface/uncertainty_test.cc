// SPDX-License-Identifier: BSD-3-Clause
// The predicted uncertainty of a surface against the scatter of many fits to the same surface with new noise.
#include "problems/surface/uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/random.h"
#include "models/nurbs_operations.h"
#include "tests/problems/surface/leaf_case.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

std::vector<Eigen::Vector3d> NormalsAt(const NurbsSurface& surface, std::span<const Eigen::Vector2d> places) {
  std::vector<Eigen::Vector3d> normals;
  for (const auto& uv : places) normals.push_back(surface.EvaluateWithDerivatives(uv[0], uv[1]).Normal());
  return normals;
}

constexpr double kNoise = 0.05;

struct Study {
  const char* name = "";
  SurfaceUnknowns unknowns = SurfaceUnknowns::kControlPoints;
  double fairness = 1e-8;
};

struct Scatter {
  std::vector<double> predicted, observed;  // standard deviations, by place
  double sigma = 0, mean_sigma = 0;
};

NurbsSurface Refit(const std::vector<Eigen::Vector3d>& points, const NurbsSurface& truth,
                   const DistanceFitOptions& options) {
  const SolverType& type = FindSolverType("lm");
  Options lm(type.options);
  lm.Set("max_iterations", std::int64_t{20});
  lm.Set("function_tolerance", 1e-9);
  lm.Set("linear_solver", std::string("sparse_normal_cholesky"));
  const SurfaceDistanceFit fit(points, truth, truth, options, 1);
  return fit.SurfaceAt(type.create(lm)->Solve(fit, {}, {}).x);
}

Scatter Compare(const Study& study, int refits) {
  const NurbsSurface truth = MakeSurface({.count_u = 7, .count_v = 7});
  DistanceFitOptions options;
  options.unknowns = study.unknowns;
  options.fairness = study.fairness;
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 15; ++j) places.emplace_back((i + 0.5) / 15, (j + 0.5) / 15);
  }
  const std::vector<Eigen::Vector3d> clean = PointsAround(truth, 2000, 0, 0, 1);
  std::vector<double> sum(places.size(), 0), squared(places.size(), 0);
  Scatter scatter;
  for (int refit = 0; refit < refits; ++refit) {
    Random random(100 + static_cast<std::uint64_t>(refit));
    std::vector<Eigen::Vector3d> points = clean;
    for (auto& point : points) {
      point += kNoise * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
    }
    const NurbsSurface fitted = Refit(points, truth, options);
    // Along the truth's normal: where that line meets the fit, to first order its foot's offset.
    std::vector<Eigen::Vector3d> at;
    for (const auto& place : places) at.push_back(truth.Evaluate(place[0], place[1]));
    const PointDistances distances = MeasureDistances(at, fitted, 1, 1);
    if (refit == 0) {
      const SurfaceUncertainty estimate =
          EstimateUncertainty(points, fitted, options, distances.feet, NormalsAt(fitted, distances.feet), 1);
      scatter.predicted = estimate.standard_deviation;
      scatter.sigma = estimate.noise_sigma;
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      sum[k] += distances.signed_distance[k];
      squared[k] += distances.signed_distance[k] * distances.signed_distance[k];
    }
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double mean = sum[k] / refits;
    scatter.observed.push_back(std::sqrt((squared[k] - refits * mean * mean) / (refits - 1)));
  }
  return scatter;
}

double Rms(const std::vector<double>& values) {
  double squared = 0;
  for (const double value : values) squared += value * value;
  return std::sqrt(squared / static_cast<double>(values.size()));
}

// FROND_REFITS raises the number of refits for a closer look.
int Refits() {
  const char* text = std::getenv("FROND_REFITS");
  return text != nullptr ? std::atoi(text) : 30;
}

class UncertaintyAgainstRefits : public ::testing::TestWithParam<Study> {};

TEST_P(UncertaintyAgainstRefits, IsWithin15PercentOfTheScatter) {
  const int refits = Refits();
  const Scatter scatter = Compare(GetParam(), refits);
  EXPECT_NEAR(scatter.sigma, kNoise, 0.05 * kNoise);
  EXPECT_NEAR(Rms(scatter.predicted) / Rms(scatter.observed), 1, 0.15);
  std::vector<double> ratios;
  for (std::size_t k = 0; k < scatter.predicted.size(); ++k) {
    ratios.push_back(scatter.predicted[k] / scatter.observed[k]);
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = ratios[ratios.size() / 2];
  EXPECT_NEAR(median, 1, 0.15);
  // A place's own scatter is known to 1 / √(2 refits) only.
  const double known = 1 / std::sqrt(2.0 * refits);
  EXPECT_GT(ratios[ratios.size() / 20], 1 - 0.1 - 2.5 * known);
  EXPECT_LT(ratios[ratios.size() - ratios.size() / 20], 1 + 0.1 + 3 * known);
  RecordProperty("rms_ratio", std::to_string(Rms(scatter.predicted) / Rms(scatter.observed)));
  RecordProperty("median_ratio", std::to_string(median));
  RecordProperty("p5_ratio", std::to_string(ratios[ratios.size() / 20]));
  RecordProperty("p95_ratio", std::to_string(ratios[ratios.size() - ratios.size() / 20]));
  RecordProperty("sigma", std::to_string(scatter.sigma));
}

INSTANTIATE_TEST_SUITE_P(Fits, UncertaintyAgainstRefits,
                         ::testing::Values(Study{.name = "control_points"},
                                           Study{.name = "free_weights", .unknowns = SurfaceUnknowns::kBoth}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Uncertainty, MovedAndScaledPoints_ScaleIt) {
  const NurbsSurface truth = MakeSurface({.count_u = 6, .count_v = 6});
  const std::vector<Eigen::Vector3d> points = PointsAround(truth, 1500, kNoise, 0, 2);
  const std::vector<Eigen::Vector2d> places = {{0.2, 0.3}, {0.5, 0.5}, {0.9, 0.1}};
  DistanceFitOptions options;
  options.fairness = 1e-7;
  const SurfaceUncertainty here =
      EstimateUncertainty(points, truth, options, places, NormalsAt(truth, places), 1);
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = 1e-3 * Eigen::AngleAxisd(2.0, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  map.translation() = Eigen::Vector3d(1, 2, 3);
  std::vector<Eigen::Vector3d> moved;
  for (const auto& point : points) moved.push_back(map * point);
  options.length_scale = 1e-3;
  const SurfaceUncertainty there = EstimateUncertainty(moved, Transformed(truth, map), options, places,
                                                       NormalsAt(Transformed(truth, map), places), 2);
  EXPECT_NEAR(there.noise_sigma, 1e-3 * here.noise_sigma, 1e-9);
  EXPECT_NEAR(there.degrees_of_freedom, here.degrees_of_freedom, 1e-3);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_NEAR(there.standard_deviation[k], 1e-3 * here.standard_deviation[k],
                1e-5 * here.standard_deviation[k]);
  }
}

TEST(Uncertainty, FourTimesThePoints_HalveIt) {
  const NurbsSurface truth = MakeSurface({.count_u = 6, .count_v = 6});
  const std::vector<Eigen::Vector2d> places = {{0.25, 0.3}, {0.5, 0.5}, {0.7, 0.4}};
  DistanceFitOptions options;
  options.fairness = 1e-9;
  const SurfaceUncertainty few = EstimateUncertainty(PointsAround(truth, 2000, kNoise, 0, 2), truth, options,
                                                     places, NormalsAt(truth, places), 1);
  const SurfaceUncertainty many = EstimateUncertainty(PointsAround(truth, 8000, kNoise, 0, 3), truth, options,
                                                      places, NormalsAt(truth, places), 1);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_NEAR(many.standard_deviation[k] / few.standard_deviation[k], 0.5, 0.08);
  }
}

}  // namespace
}  // namespace frond
