// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/random.h"
#include "problems/leaf/leaf_paper_fit.h"
#include "solvers/solver.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

LeafWeightsFit WeightsOf(int leaf, const LeafWeightsOptions& options = {}) {
  const LeafPaperFit start = FitLeafAsInPaper(ScannedLeaf(leaf).points, {});
  return LeafWeightsFit(start.surface, start.test_points, options);
}

std::vector<double> RandomWeights(std::uint64_t seed, double spread) {
  Random random(seed);
  std::vector<double> weights(25);
  for (double& w : weights) w = random.Uniform(1 - spread, 1 + spread);
  return weights;
}

TEST(LeafWeights, Objective_IsThatOfAGlobalSearch) {
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafWeightsFit fit = WeightsOf(leaf);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const std::vector<double> x = RandomWeights(seed, 0.1);
      EXPECT_NEAR(fit.Objective(x), fit.Metrics(x).at("objective"), 1e-6) << "leaf " << leaf;
    }
  }
}

TEST(LeafWeights, ObjectiveOfSpreadWeights_IsThatOfAGlobalSearchOrAbove) {
  int above = 0, all = 0;
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafWeightsFit fit = WeightsOf(leaf);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random(seed);
      std::vector<double> x(25);
      for (double& w : x) w = std::exp(random.Uniform(-0.5, 0.5));
      const double global = fit.Metrics(x).at("objective");
      EXPECT_GT(fit.Objective(x), global * (1 - 1e-6)) << "leaf " << leaf;
      above += fit.Objective(x) > global * (1 + 1e-6) ? 1 : 0;
      ++all;
    }
  }
  EXPECT_LE(above, all / 50);
}

TEST(LeafWeights, SumOfSquares_IsAnObjectiveToo) {
  const LeafWeightsFit fit = WeightsOf(1, {.objective = {}, .sum_of_squares = true});
  EXPECT_TRUE(fit.ObjectiveIsLeastSquares());
  const double rmse = fit.Metrics(fit.StartVector()).at("rmse");
  EXPECT_NEAR(fit.Objective(fit.StartVector()), 0.5 * 90 * rmse * rmse, 1e-6);
  LeastSquares least_squares(fit, 1);
  EXPECT_NEAR(least_squares.Cost(), fit.Objective(fit.StartVector()), 1e-9);
}

TEST(LeafWeights, Objective_IsTheSumOfItsShares) {
  const LeafWeightsFit fit = WeightsOf(1, {.objective = {.rmse_share = 0.3, .max_share = 0.7}});
  const auto metrics = fit.Metrics(fit.StartVector());
  EXPECT_NEAR(metrics.at("objective"), 0.3 * metrics.at("rmse") + 0.7 * metrics.at("max"), 1e-12);
  EXPECT_FALSE(fit.ObjectiveIsLeastSquares());
}

TEST(LeafWeights, Objective_DoesNotChangeWithTheWeightsScale) {
  const LeafWeightsFit fit = WeightsOf(2);
  std::vector<double> x = RandomWeights(1, 0.1);
  const double objective = fit.Objective(x);
  for (double& w : x) w *= 1.07;
  EXPECT_NEAR(fit.Objective(x), objective, 1e-9);
}

TEST(LeafWeights, WeightsNotAboveZero_AreInfinitelyBad) {
  const LeafWeightsFit fit = WeightsOf(1);
  std::vector<double> x(25, 1.0);
  x[3] = 0;
  EXPECT_EQ(fit.Objective(x), std::numeric_limits<double>::infinity());
  x[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fit.Objective(x), std::numeric_limits<double>::infinity());
}

TEST(LeafWeights, Gradient_IsThatOfHalfTheSquaredDistances) {
  LeafWeightsOptions options;
  options.objective = {.rmse_share = 1, .max_share = 0};
  for (int leaf = 1; leaf <= 3; ++leaf) {
    const LeafWeightsFit fit = WeightsOf(leaf, options);
    const auto half_squares = [&](const std::vector<double>& x) {
      const double rmse = fit.Objective(x);
      return 0.5 * 90 * rmse * rmse;
    };
    const std::vector<double> x = RandomWeights(7, 0.1);
    LeastSquares least_squares(fit, 1);
    least_squares.SetX(x);
    double cost = 0;
    std::vector<double> gradient;
    least_squares.problem().Evaluate({}, &cost, nullptr, &gradient, nullptr);
    EXPECT_NEAR(cost, half_squares(x), 1e-9 * cost);
    for (std::size_t k = 0; k < x.size(); ++k) {
      std::vector<double> more = x, less = x;
      more[k] += 1e-5;
      less[k] -= 1e-5;
      const double numeric = (half_squares(more) - half_squares(less)) / 2e-5;
      EXPECT_NEAR(gradient[k], numeric, 1e-6 + 1e-4 * std::abs(numeric))
          << "leaf " << leaf << ", weight " << k;
    }
  }
}

TEST(LeafWeights, LmOnItsRows_LowersTheRmseAndTheObjective) {
  const SolverType& type = FindSolverType("lm");
  const auto lm = type.create(Options(type.options));
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafWeightsFit fit = WeightsOf(leaf);
    const SolverReport report = lm->Solve(fit, {}, {});
    const auto before = fit.Metrics(fit.StartVector()), after = fit.Metrics(report.x);
    EXPECT_LT(after.at("rmse"), 0.95 * before.at("rmse")) << "leaf " << leaf;
    EXPECT_LT(report.objective, before.at("objective"));
    EXPECT_NEAR(report.objective, after.at("objective"), 1e-6);
  }
}

TEST(LeafWeights, PapersProjection_IsNeverBelowTheNearestFoot) {
  const LeafPaperFit start = FitLeafAsInPaper(ScannedLeaf(2).points, {});
  LeafWeightsOptions options;
  const LeafWeightsFit tracked(start.surface, start.test_points, options);
  options.projection = WeightProjection::kPaper;
  const LeafWeightsFit paper(start.surface, start.test_points, options);
  EXPECT_GE(paper.Objective(paper.StartVector()), tracked.Objective(tracked.StartVector()) - 1e-9);
}

TEST(LeafWeights, OptionsAndPoints_AreChecked) {
  const LeafPaperFit start = FitLeafAsInPaper(ScannedLeaf(1).points, {});
  const auto& points = start.test_points;
  EXPECT_THROW(LeafWeightsFit(start.surface, {}, {}), InputError);
  EXPECT_THROW(LeafWeightsFit(start.surface, points, {.objective = {.rmse_share = 0.8, .max_share = 0.3}}),
               ConfigError);
  EXPECT_THROW(LeafWeightsFit(start.surface, points, {.objective = {}, .lower = 0, .upper = 2}), ConfigError);
  EXPECT_THROW(LeafWeightsFit(start.surface, points, {.objective = {}, .lower = 1.1, .upper = 2}),
               ConfigError);
}

}  // namespace
}  // namespace frond
