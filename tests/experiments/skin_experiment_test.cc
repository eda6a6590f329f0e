// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/skin_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/errors.h"
#include "problems/skinning/skin_fit.h"
#include "solvers/solver.h"

namespace frond {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

FitOutcome Skinned(std::vector<Eigen::Vector3d> points) {
  RunInput input;
  input.cloud.points = std::move(points);
  const SolverType& type = FindSolverType("lm");
  return SkinFitType().run(input, Options(SkinFitSpecs()), *type.create(Options(type.options)), {},
                           {{.threads = 1, .seed = 1}});
}

// `count` golden-ratio points (s, t) of the unit square.
std::vector<Eigen::Vector2d> Spread(int count) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < count; ++i) {
    places.emplace_back((i + 0.5) / count, std::fmod(i * std::numbers::phi, 1.0));
  }
  return places;
}

std::vector<Eigen::Vector3d> Tube(double x) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& p : Spread(1500)) {
    points.emplace_back(x + std::cos(kTurn * p.y()), std::sin(kTurn * p.y()), 6 * p.x());
  }
  return points;
}

TEST(SkinExperiment, Tube_IsSkinnedWithoutACountOfOutliersThatNobodyLookedFor) {
  const FitOutcome outcome = Skinned(Tube(0));
  EXPECT_LT(outcome.metrics.Number("rmse"), 0.01);
  EXPECT_EQ(outcome.metrics.Find("outliers"), nullptr);
}

TEST(SkinExperiment, SheetsTorusesAndParts_AreRefused) {
  std::vector<Eigen::Vector3d> sheet, torus, parts = Tube(0);
  for (const auto& p : Spread(1500)) {
    sheet.emplace_back(8 * p.x(), 5 * p.y(), std::sin(2 * p.x()));
    const double across = 3 + std::cos(kTurn * p.x());
    torus.emplace_back(across * std::cos(kTurn * p.y()), across * std::sin(kTurn * p.y()),
                       std::sin(kTurn * p.x()));
  }
  for (const auto& point : Tube(5)) parts.push_back(point);
  EXPECT_THROW(Skinned(sheet), FitError);
  EXPECT_THROW(Skinned(torus), FitError);
  EXPECT_THROW(Skinned(parts), FitError);
}

}  // namespace
}  // namespace frond
