// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/linear_start.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.h"
#include "base/random.h"
#include "models/knot_vector.h"
#include "tests/models/closed_surfaces.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

struct Samples {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> parameters;
};

Samples SamplesOf(const NurbsSurface& surface, int count) {
  Random random(2);
  Samples samples;
  for (int i = 0; i < count; ++i) {
    samples.parameters.emplace_back(random.Uniform(surface.u().begin(), surface.u().end()),
                                    random.Uniform(surface.v().begin(), surface.v().end()));
    samples.points.push_back(surface.Evaluate(samples.parameters.back()[0], samples.parameters.back()[1]));
  }
  return samples;
}

double LargestDifference(const NurbsSurface& a, const NurbsSurface& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.control_points().size(); ++k) {
    largest = std::max(largest, (a.control_points()[k] - b.control_points()[k]).norm());
  }
  return largest;
}

TEST(FitAtParameters, ASurfaceOfItsOwnSplineSpace_IsReproduced) {
  for (const auto& [p, q] : std::vector<std::pair<int, int>>{{3, 3}, {1, 2}, {2, 5}, {4, 3}}) {
    const NurbsSurface truth = MakeSurface({.degree_u = p, .degree_v = q, .uneven_knots = true});
    const Samples samples = SamplesOf(truth, 3000);
    const NurbsSurface fit = FitAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 0);
    EXPECT_LT(LargestDifference(fit, truth), 1e-8) << p << " x " << q;
    const NurbsSurface smoothed =
        FitAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), 1e-16);
    EXPECT_LT(LargestDifference(smoothed, truth), 1e-6) << p << " x " << q;
  }
}

TEST(FitAtParameters, PeriodicSurface_IsReproducedWithEqualRepeats) {
  const BSplineBasis u = PeriodicUniformBasis(3, 6), v = UniformBasis(2, 5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 5; ++j) {
      const double a = 2 * M_PI * (i % 6) / 6;
      points.emplace_back(std::cos(a) * (2 + 0.1 * j), std::sin(a) * (2 + 0.1 * j), j);
    }
  }
  const NurbsSurface tube(u, v, points);
  const Samples samples = SamplesOf(tube, 2000);
  const NurbsSurface fit = FitAtParameters(samples.points, samples.parameters, u, v, 0);
  EXPECT_LT(LargestDifference(fit, tube), 1e-9);
}

TEST(FitAtParameters, SurfaceWithPoles_IsReproduced) {
  for (const PoleEnds poles : {PoleEnds{true, false}, PoleEnds{false, true}, PoleEnds{true, true}}) {
    const NurbsSurface egg = Egg(poles);
    const Samples samples = SamplesOf(egg, 3000);
    const NurbsSurface fit = FitAtParameters(samples.points, samples.parameters, egg.u(), egg.v(), 0, poles);
    EXPECT_LT(LargestDifference(fit, egg), 1e-9);
  }
}

TEST(FitAtParameters, WithPoles_IsC1EvenWhereTheDataIsNot) {
  const PoleEnds poles{.begin = true, .end = true};
  const NurbsSurface tube = Egg({});  // open at both ends
  const Samples samples = SamplesOf(tube, 3000);
  const NurbsSurface fit =
      FitAtParameters(samples.points, samples.parameters, tube.u(), tube.v(), 1e-9, poles);
  for (const double v : {1e-7, 1 - 1e-7}) {
    const Eigen::Vector3d normal = fit.EvaluateWithDerivatives(0, v).Normal();
    for (int k = 1; k < 9; ++k) {
      EXPECT_LT((fit.EvaluateWithDerivatives(k / 9.0, v).Normal() - normal).norm(), 1e-4);
    }
  }
}

TEST(FitAtParameters, Fairness_CarriesTheSurfaceOverAHole) {
  const NurbsSurface truth = MakeSurface({.roughness = 0.1});
  Samples samples = SamplesOf(truth, 3000), holed;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    if ((samples.parameters[i] - Eigen::Vector2d(0.5, 0.5)).norm() < 0.25) continue;
    holed.points.push_back(samples.points[i]);
    holed.parameters.push_back(samples.parameters[i]);
  }
  const NurbsSurface fit =
      FitAtParameters(holed.points, holed.parameters, UniformBasis(3, 14), UniformBasis(3, 14), 1e-7);
  EXPECT_LT((fit.Evaluate(0.5, 0.5) - truth.Evaluate(0.5, 0.5)).norm(), 1);
}

TEST(FitAtParameters, MoreFairness_GivesLessEnergyAndMoreError) {
  const NurbsSurface truth = MakeSurface({});
  const Samples samples = SamplesOf(truth, 2000);
  double last = 0;
  for (const double fairness : {1e-9, 1e-6, 1e-3, 1.0}) {
    const NurbsSurface fit =
        FitAtParameters(samples.points, samples.parameters, truth.u(), truth.v(), fairness);
    double squared = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      squared += (fit.Evaluate(samples.parameters[i][0], samples.parameters[i][1]) - samples.points[i])
                     .squaredNorm();
    }
    EXPECT_GT(squared, last);
    last = squared;
  }
}

TEST(FitAtParameters, CellsWithoutPointsOrFairness_AreAnError) {
  Samples samples = SamplesOf(MakeSurface({}), 500);
  for (auto& uv : samples.parameters) uv *= 0.2;
  EXPECT_THROW(
      FitAtParameters(samples.points, samples.parameters, UniformBasis(3, 10), UniformBasis(3, 10), 0),
      FitError);
}

}  // namespace
}  // namespace frond
