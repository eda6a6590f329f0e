// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/ceres_solvers.h"

#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/errors.h"
#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

SolverReport Solve(const std::string& name, const FitProblem& fit, const Budget& budget = {},
                   const std::vector<std::pair<std::string, OptionValue>>& options = {}) {
  return MakeSolver(name, options)->Solve(fit, budget, {});
}

void ExpectMinimum(const SolverReport& report) {
  EXPECT_EQ(report.termination, Termination::kConverged) << report.message;
  EXPECT_NEAR(report.x[0], 1, 1e-6);
  EXPECT_NEAR(report.x[1], 1, 1e-6);
  EXPECT_NEAR(report.objective, 0, 1e-12);
}

TEST(CeresSolvers, Lm_OnRosenbrock_ReachesMinimum) { ExpectMinimum(Solve("lm", RosenbrockFit())); }

TEST(CeresSolvers, Dogleg_OnRosenbrock_ReachesMinimum) {
  ExpectMinimum(Solve("dogleg", RosenbrockFit()));
  ExpectMinimum(Solve("dogleg", RosenbrockFit(), {}, {{"dogleg_type", std::string("subspace")}}));
}

TEST(CeresSolvers, Lbfgs_OnRosenbrock_ReachesMinimum) { ExpectMinimum(Solve("lbfgs", RosenbrockFit())); }

TEST(CeresSolvers, Lm_WithEveryLinearSolver_ReachesMinimum) {
  for (const char* solver : {"dense_qr", "dense_normal_cholesky", "sparse_normal_cholesky"}) {
    SCOPED_TRACE(solver);
    ExpectMinimum(Solve("lm", RosenbrockFit(), {}, {{"linear_solver", std::string(solver)}}));
  }
}

TEST(CeresSolvers, Lm_NonmonotonicSteps_ReturnTheBest) {
  ExpectMinimum(Solve("lm", RosenbrockFit(), {}, {{"nonmonotonic_steps", true}}));
}

TEST(CeresSolvers, Lm_OnMisra1a_ReachesCertifiedValues) {
  const SolverReport report = Solve("lm", Misra1aFit());
  EXPECT_NEAR(report.x[0], Misra1aFit::kB1, 1e-8 * Misra1aFit::kB1);
  EXPECT_NEAR(report.x[1], Misra1aFit::kB2, 1e-8 * Misra1aFit::kB2);
  EXPECT_NEAR(report.objective, Misra1aFit::kResidualSumOfSquares / 2, 1e-11);
}

TEST(CeresSolvers, LinearLeastSquares_IsSolvedByAll) {
  for (const char* name : {"lm", "dogleg", "lbfgs"}) {
    const SolverReport report = Solve(name, LineFit());
    EXPECT_NEAR(report.x[0], 1.5, 1e-6) << name;
    EXPECT_NEAR(report.x[1], 1.0, 1e-6) << name;
    EXPECT_NEAR(report.objective, 0.5, 1e-10) << name;
  }
}

TEST(CeresSolvers, Lm_AtABound_StopsThere) {
  RosenbrockFit fit;
  SetBox(-2, 0.5, &fit);
  fit.blocks[0].start = {-1.2, 0.2};
  const SolverReport report = Solve("lm", fit);
  EXPECT_NEAR(report.x[0], 0.5, 1e-6);
  EXPECT_NEAR(report.x[1], 0.25, 1e-5);
}

TEST(CeresSolvers, Lbfgs_WithBounds_IsRefusedByName) {
  RosenbrockFit fit;
  fit.blocks[0].lower = {-HUGE_VAL, -HUGE_VAL};
  EXPECT_NO_THROW(Solve("lbfgs", fit)) << "infinite bounds are none";
  SetBox(-2, 2, &fit);
  try {
    Solve("lbfgs", fit);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "solver 'lbfgs' cannot hold bounds, and parameter 'x' has some: use lm, dogleg, pso or pso_lm");
  }
}

TEST(CeresSolvers, StartThatCannotBeEvaluated_FailsWithCeresReason) {
  for (const char* name : {"lm", "dogleg", "lbfgs"}) {
    const SolverReport report = Solve(name, PartlyNanFit(-1, 0));
    EXPECT_EQ(report.termination, Termination::kFailed);
    EXPECT_FALSE(report.message.empty());
    EXPECT_EQ(report.x, std::vector<double>{-1});
    EXPECT_TRUE(std::isnan(report.objective));
  }
}

TEST(CeresSolvers, Lm_StepIntoNan_IsTakenBack) {
  // The Gauss–Newton step of Rosenbrock's fit from afar is fine; here x = 5 → 1 must not pass below 0.5 only.
  const SolverReport report = Solve("lm", PartlyNanFit(5, 0.5));
  EXPECT_EQ(report.termination, Termination::kConverged);
  EXPECT_NEAR(report.x[0], 1, 1e-6);
  // The minimum itself is out of reach: the best finite point is returned.
  const SolverReport blocked = Solve("lm", PartlyNanFit(5, 2));
  EXPECT_GE(blocked.x[0], 2);
  EXPECT_TRUE(std::isfinite(blocked.objective));
}

TEST(CeresSolvers, AllConstant_ReportsTheStart) {
  RosenbrockFit fit;
  fit.blocks[0].constant = true;
  const SolverReport report = Solve("lm", fit);
  EXPECT_EQ(report.termination, Termination::kConverged);
  EXPECT_EQ(report.x, fit.StartVector());
  EXPECT_DOUBLE_EQ(report.objective, fit.Objective(report.x));
}

TEST(CeresSolvers, ConstantBlock_StaysAtItsStart) {
  Misra1aFit fit;
  fit.blocks[1].constant = true;
  const SolverReport report = Solve("lm", fit);
  EXPECT_EQ(report.x[1], 0.0005);
  EXPECT_NE(report.x[0], 250);
  EXPECT_EQ(report.evaluations, report.residual_evaluations + report.jacobian_evaluations);
}

TEST(CeresSolvers, Manifold_IsFollowed) {
  RosenbrockFit fit;
  fit.blocks[0].start = {3, 4};
  fit.blocks[0].manifold = std::make_shared<ceres::SphereManifold<ceres::DYNAMIC>>(2);
  for (const char* name : {"lm", "lbfgs"}) {
    const SolverReport report = Solve(name, fit);
    EXPECT_NEAR(std::hypot(report.x[0], report.x[1]), 5, 1e-9) << name;
  }
}

TEST(CeresSolvers, NumericDerivatives_AreChargedTwice) {
  RosenbrockFit fit;
  fit.derivatives_charged = Derivatives::kNumeric;
  const SolverReport report = Solve("lm", fit);
  EXPECT_EQ(report.evaluations, report.residual_evaluations + 4 * report.jacobian_evaluations);
}

TEST(CeresSolvers, MaxIterations_IsAnIterationLimit) {
  const SolverReport report = Solve("lm", RosenbrockFit(), {}, {{"max_iterations", 3}});
  EXPECT_EQ(report.termination, Termination::kIterationLimit);
  EXPECT_EQ(report.iterations, 3);
  const SolverReport start = Solve("lm", RosenbrockFit(), {}, {{"max_iterations", 0}});
  EXPECT_EQ(start.termination, Termination::kIterationLimit);
  EXPECT_EQ(start.x, RosenbrockFit().StartVector());
}

TEST(CeresSolvers, OtherObjective_IsReportedInItsOwnUnit) {
  const MinimaxFit fit(-3);
  for (const char* name : {"lm", "dogleg", "lbfgs"}) {
    const SolverReport report = Solve(name, fit);
    EXPECT_NEAR(report.x[0], 2, 1e-6) << name;
    EXPECT_DOUBLE_EQ(report.objective, fit.Objective(report.x)) << name;
    EXPECT_DOUBLE_EQ(report.trace.front().best_objective, fit.Objective(fit.StartVector())) << name;
    EXPECT_DOUBLE_EQ(report.trace.back().best_objective, report.objective) << name;
  }
}

TEST(CeresSolvers, OtherObjectiveThatGotWorse_IsReportedHonestly) {
  const MinimaxFit fit(1, /*agree=*/false);  // the objective's minimum; least squares leave it
  const SolverReport report = Solve("lm", fit);
  EXPECT_NEAR(report.x[0], 2, 1e-6);
  EXPECT_NEAR(report.objective, 5, 1e-5);
  EXPECT_DOUBLE_EQ(report.trace.back().best_objective, 3);
}

TEST(CeresSolvers, OtherObjective_StopsOnItsTarget) {
  const MinimaxFit fit(1, /*agree=*/false);
  const SolverReport report = Solve("lm", fit, {.target_objective = 3});
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_EQ(report.x[0], 1);
}

}  // namespace
}  // namespace frond
