// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/ma_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "base/random.h"
#include "models/knot_vector.h"
#include "problems/surface/parametric_fit.h"
#include "problems/surface/rational_sums.h"
#include "problems/surface/sheet_start.h"
#include "problems/surface/surface_quality.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

struct Samples {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> parameters;  // in [0, 1]²
};

Samples SamplesOf(const NurbsSurface& surface, int count, double noise = 0) {
  Random random(2);
  Samples samples;
  for (int i = 0; i < count; ++i) {
    const double s = random.Uniform(), t = random.Uniform();
    samples.parameters.emplace_back(s, t);
    samples.points.push_back(
        surface.Evaluate(surface.u().begin() + s * (surface.u().end() - surface.u().begin()),
                         surface.v().begin() + t * (surface.v().end() - surface.v().begin())) +
        noise * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  return samples;
}

TEST(MaFit, PointsOfARationalSurface_GiveItsWeightsAndControlPoints) {
  for (const bool uneven : {false, true}) {
    const NurbsSurface truth = MakeSurface({.degree_u = 2, .uneven_knots = uneven, .rational = true});
    const Samples samples = SamplesOf(truth, 3000);
    const NurbsSurface fit =
        FitRationalAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 0);
    const double mean = std::accumulate(truth.weights().begin(), truth.weights().end(), 0.0) /
                        static_cast<double>(truth.weights().size());
    for (std::size_t k = 0; k < fit.weights().size(); ++k) {
      EXPECT_NEAR(fit.weights()[k], truth.weights()[k] / mean, 1e-6) << k;
      EXPECT_LT((fit.control_points()[k] - truth.control_points()[k]).norm(), 1e-5) << k;
    }
  }
}

TEST(MaFit, NoisyPoints_GetPositiveWeightsAndLessErrorThanEqualOnes) {
  const NurbsSurface truth = MakeSurface({.rational = true});
  constexpr double kNoise = 0.005;
  const Samples samples = SamplesOf(truth, 3000, kNoise);
  const auto fit_with = [&](bool free_weights) {
    return FitAtFixedParameters(samples.points, samples.parameters, truth.u(), truth.v(),
                                {.free_weights = free_weights, .fairness = 1e-12, .repetitions = 0}, 1);
  };
  const ParametricFit equal = fit_with(false), free = fit_with(true);
  EXPECT_LT(std::sqrt(free.squared_sum / 3000), 1.1 * kNoise * std::sqrt(3));
  EXPECT_LT(free.squared_sum, 0.1 * equal.squared_sum);  // that surface is not polynomial
  EXPECT_GE(*std::min_element(free.surface.weights().begin(), free.surface.weights().end()),
            0.99 * kLeastWeight);
}

TEST(MaFit, MovedAndScaledPoints_GiveTheMovedSurface) {
  const NurbsSurface truth = MakeSurface({.rational = true});
  Samples samples = SamplesOf(truth, 2000, 0.01);
  const NurbsSurface fit =
      FitRationalAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 1e-9);
  const Eigen::Vector3d shift(1e3, -2e3, 500);
  for (auto& point : samples.points) point = 1e-3 * point + shift;
  const NurbsSurface moved =
      FitRationalAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 1e-9);
  for (std::size_t k = 0; k < fit.weights().size(); ++k) {
    EXPECT_NEAR(moved.weights()[k], fit.weights()[k], 1e-4);
    EXPECT_LT((moved.control_points()[k] - shift - 1e-3 * fit.control_points()[k]).norm(), 1e-6);
  }
}

TEST(MaFit, PeriodicBasis_RepeatsItsFirstControlPoints) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> parameters;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double angle = 2 * M_PI * i / 60;
      points.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), j);
      parameters.emplace_back(i / 60.0, j / 19.0);
    }
  }
  const NurbsSurface fit =
      FitRationalAtParameters(points, parameters, PeriodicUniformBasis(3, 12), UniformBasis(2, 4), 1e-12);
  for (int j = 0; j < 4; ++j) EXPECT_EQ(fit.control_point(0, j), fit.control_point(12, j));
  double largest = 0;
  for (const double d : MeasureDistances(points, fit, 1).signed_distance)
    largest = std::max(largest, std::abs(d));
  EXPECT_LT(largest, 2e-3);
}

TEST(MaFit, TooFewPointsOrTooManyWeights_AreRefused) {
  const NurbsSurface truth = MakeSurface({});
  const Samples samples = SamplesOf(truth, 20);
  EXPECT_THROW(FitRationalAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 0),
               FitError);
  EXPECT_THROW(FitRationalAtParameters(samples.points, samples.parameters, UniformBasis(3, 60),
                                       UniformBasis(3, 60), 1e-8),
               ConfigError);
}

TEST(ParametricFit, RepeatingTheBaseSurface_LowersTheParametricError) {
  const NurbsSurface truth = MakeSurface({.roughness = 0.4});
  const Samples samples = SamplesOf(truth, 3000);
  const auto fit_with = [&](int repetitions) {
    return FitAtFixedParameters(samples.points, RectangleParameters(samples.points, samples.points, 0),
                                truth.u(), truth.v(), {.fairness = 1e-10, .repetitions = repetitions}, 1);
  };
  const ParametricFit once = fit_with(0), repeated = fit_with(8);
  EXPECT_EQ(once.history.size(), 1U);
  EXPECT_GE(repeated.history.size(), 3U);
  EXPECT_EQ(repeated.history.front(), once.squared_sum);
  EXPECT_LT(repeated.squared_sum, 0.95 * once.squared_sum);
  EXPECT_EQ(repeated.squared_sum, *std::min_element(repeated.history.begin(), repeated.history.end()));
}

}  // namespace
}  // namespace frond
