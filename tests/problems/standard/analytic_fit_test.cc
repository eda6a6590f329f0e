// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/analytic_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "problems/standard/analytic_functions.h"
#include "tests/problems/standard/fit_checks.h"

namespace frond {
namespace {

using std::numbers::e;
using std::numbers::pi;

const std::vector<std::string>& Names() {
  static const std::vector<std::string> names = {"ackley",     "griewank", "rastrigin",
                                                 "rosenbrock", "schwefel", "sphere"};
  return names;
}

const std::vector<AnalyticPlacement>& Placements() {
  static const std::vector<AnalyticPlacement> placements = {
      {}, {.shift = true}, {.rotate = true}, {.shift = true, .rotate = true, .instance = 7}};
  return placements;
}

double Value(const std::string& name, const std::vector<double>& x) {
  return AnalyticFit(name, static_cast<int>(x.size())).Objective(x);
}

// A point of the fit's box, `stretch` times as wide.
std::vector<double> RandomPoint(const AnalyticFit& fit, double stretch, Random* random) {
  std::vector<double> x;
  for (const double upper : fit.parameters()[0].upper) x.push_back(stretch * random->Uniform(-upper, upper));
  return x;
}

TEST(AnalyticFunctions, Values_AtKnownPoints_AreTheTextbooks) {
  EXPECT_DOUBLE_EQ(Value("sphere", {3, -4}), 25);
  EXPECT_DOUBLE_EQ(Value("rosenbrock", {-1.2, 1}), 24.2);
  EXPECT_DOUBLE_EQ(Value("rosenbrock", {2, 2, 2}), 2 * (400 + 1));
  EXPECT_NEAR(Value("rastrigin", {1, -2, 3}), 1 + 4 + 9, 1e-12);
  EXPECT_DOUBLE_EQ(Value("rastrigin", {0.5, 0}), 0.25 + 20);
  EXPECT_NEAR(Value("griewank", {pi, 0}), 2 + pi * pi / 4000, 1e-15);
  EXPECT_NEAR(Value("griewank", {0, 0, 0, 2 * pi}), 2 + pi * pi / 1000, 1e-15);
  EXPECT_NEAR(Value("ackley", {1, -1}), 20 * (1 - std::exp(-0.2)), 1e-14);
  EXPECT_NEAR(Value("ackley", {0.5, 0.5}), 20 * (1 - std::exp(-0.1)) + e - std::exp(-1), 1e-14);
  EXPECT_NEAR(Value("schwefel", {0, 0}), 2 * 418.9828872724337, 1e-12);
  EXPECT_NEAR(Value("schwefel", {pi * pi / 4, 0}), 2 * 418.9828872724337 - pi * pi / 4, 1e-12);
}

TEST(AnalyticFunctions, Schwefel_OverItsEdge_GoesOnContinuouslyAndUp) {
  for (const double edge : {500.0, -500.0}) {
    EXPECT_NEAR(SchwefelFunction::Term(edge * (1 + 1e-12)), SchwefelFunction::Term(edge), 1e-8);
    EXPECT_NEAR(SchwefelFunction::Term(edge * 1.2), SchwefelFunction::Term(edge) + 100, 1e-9);
  }
}

TEST(AnalyticFit, Objective_AtMinimiser_IsZeroWithinResolution) {
  for (const AnalyticPlacement& placement : Placements()) {
    for (const int dimension : {2, 10, 30}) {
      for (const TestProblem& problem : Problems("functions", {{"dimension", std::int64_t{dimension}},
                                                               {"shift", placement.shift},
                                                               {"rotate", placement.rotate}})) {
        SCOPED_TRACE(problem.name);
        const auto fit = problem.make();
        EXPECT_EQ(problem.best_objective, 0.0);
        EXPECT_NEAR(fit->Objective(problem.best_x), 0, problem.resolution);
        for (std::size_t j = 0; j < problem.best_x.size(); ++j) {
          EXPECT_GT(problem.best_x[j], fit->parameters()[0].lower[j]);
          EXPECT_LT(problem.best_x[j], fit->parameters()[0].upper[j]);
        }
      }
    }
  }
}

TEST(AnalyticFit, Objective_Anywhere_IsNotBelowZero) {
  Random random(1);
  for (const std::string& name : Names()) {
    for (const AnalyticPlacement& placement : Placements()) {
      const AnalyticFit fit(name, 5, placement);
      for (int i = 0; i < 2000; ++i) EXPECT_GT(fit.Objective(RandomPoint(fit, 1.5, &random)), 0) << name;
    }
  }
}

TEST(AnalyticFit, Objective_IsTheCeresCost) {
  Random random(2);
  for (const std::string& name : Names()) {
    for (const AnalyticPlacement& placement : Placements()) {
      SCOPED_TRACE(name);
      const AnalyticFit fit(name, 6, placement);
      ExpectObjectiveIsCeresCost(fit, fit.StartVector());
      ExpectObjectiveIsCeresCost(fit, fit.minimiser(), 1e-13, 6e-12);
      for (int i = 0; i < 20; ++i) ExpectObjectiveIsCeresCost(fit, RandomPoint(fit, 1, &random));
    }
  }
}

TEST(AnalyticFit, Gradient_MatchesDifferencesAndIsFiniteAtTheMinimiser) {
  for (const std::string& name : Names()) {
    for (const AnalyticPlacement& placement : Placements()) {
      SCOPED_TRACE(name);
      const AnalyticFit fit(name, 6, placement);
      ExpectGradientMatchesDifferences(fit, fit.StartVector());
      for (const double slope : CeresGradient(fit, fit.minimiser())) EXPECT_TRUE(std::isfinite(slope));
      for (const double slope : CeresGradient(fit, std::vector<double>(6, 0.0))) {
        EXPECT_TRUE(std::isfinite(slope));
      }
    }
  }
}

TEST(AnalyticFit, Objective_OfNan_IsNanAndNotSmall) {
  for (const std::string& name : Names()) {
    const std::vector<double> x = {1, std::nan("")};
    EXPECT_TRUE(std::isnan(AnalyticFit(name, 2).Objective(x))) << name;
    EXPECT_TRUE(std::isnan(CeresCost(AnalyticFit(name, 2), x))) << name;
  }
}

TEST(AnalyticFit, Placement_MapsTheTextbooksNeighbourhoodOfItsMinimiser) {
  Random random(3);
  for (const std::string& name : Names()) {
    const AnalyticFit plain(name, 5), placed(name, 5, {.shift = true, .rotate = true, .instance = 4});
    for (int i = 0; i < 50; ++i) {
      Eigen::VectorXd d(5);
      for (int j = 0; j < 5; ++j) d[j] = random.Normal();
      const Eigen::VectorXd turned = placed.rotation().transpose() * d;
      std::vector<double> z = plain.minimiser(), x = placed.minimiser();
      for (std::size_t j = 0; j < 5; ++j) {
        z[j] += d[static_cast<Eigen::Index>(j)];
        x[j] += turned[static_cast<Eigen::Index>(j)];
      }
      EXPECT_NEAR(placed.Objective(x), plain.Objective(z), 1e-10 * (1 + plain.Objective(z))) << name;
    }
  }
}

TEST(AnalyticFit, Rotation_IsOrthogonal) {
  for (const int dimension : {2, 10, 40}) {
    const Eigen::MatrixXd r = AnalyticFit("ackley", dimension, {.rotate = true}).rotation();
    EXPECT_LT((r.transpose() * r - Eigen::MatrixXd::Identity(dimension, dimension)).norm(), 1e-13);
    EXPECT_GT((r - Eigen::MatrixXd::Identity(dimension, dimension)).norm(), 0.1);
  }
  EXPECT_EQ(AnalyticFit("ackley", 3).rotation().size(), 0);
}

TEST(AnalyticFit, Instance_DecidesPlacementAlone) {
  for (const std::string& name : Names()) {
    const AnalyticPlacement third{.shift = true, .rotate = true, .instance = 3};
    const AnalyticPlacement fourth{.shift = true, .rotate = true, .instance = 4};
    const AnalyticFit first(name, 8, third), again(name, 8, third), other(name, 8, fourth);
    EXPECT_EQ(first.minimiser(), again.minimiser());
    EXPECT_EQ(first.rotation(), again.rotation());
    EXPECT_EQ(first.Objective(first.StartVector()), again.Objective(first.StartVector()));
    EXPECT_NE(first.minimiser(), other.minimiser());
    EXPECT_NE(first.rotation(), other.rotation());
    EXPECT_EQ(first.StartVector(), other.StartVector());
  }
}

TEST(AnalyticFit, Start_IsFarFromEveryMinimiserAndInItsBox) {
  for (const std::string& name : Names()) {
    for (const AnalyticPlacement& placement : Placements()) {
      for (const int dimension : {2, 10}) {
        const AnalyticFit fit(name, dimension, placement);
        EXPECT_NO_THROW(CheckParameters(fit));
        const std::vector<double> start = fit.StartVector();
        double square = 0;
        for (std::size_t j = 0; j < start.size(); ++j) square += std::pow(start[j] - fit.minimiser()[j], 2);
        EXPECT_GT(std::sqrt(square / dimension), 0.1 * fit.parameters()[0].upper[0]) << name;
      }
    }
  }
}

TEST(AnalyticFit, Lm_OnPlacedSphere_EndsAtItsMinimiser) {
  const AnalyticFit fit("sphere", 10, {.shift = true, .rotate = true, .instance = 2});
  const SolverReport report = SolveWith("lm", fit);
  for (std::size_t j = 0; j < 10; ++j) EXPECT_NEAR(report.x[j], fit.minimiser()[j], 1e-9);
}

}  // namespace
}  // namespace frond
