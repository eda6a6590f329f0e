// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/refinement.h"

#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "test_fits.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

using OptionList = std::vector<std::pair<std::string, OptionValue>>;

OptionList ZeroTolerances(bool refine) {
  return {{"function_tolerance", 0.0},
          {"gradient_tolerance", 0.0},
          {"parameter_tolerance", 0.0},
          {"refine", refine}};
}

// Correct digits, as NIST counts them.
double Digits(double value, double certified) { return -std::log10(std::abs(value - certified) / certified); }

double FewerDigits(const std::vector<double>& x) {
  return std::min(Digits(x.at(0), Misra1aFit::kB1), Digits(x.at(1), Misra1aFit::kB2));
}

TEST(Refinement, OfMisra1a_FindsTenCertifiedDigitsOfBothParameters) {
  for (const char* name : {"lm", "dogleg"}) {
    const Misra1aFit fit;
    const SolverReport report = MakeSolver(name, ZeroTolerances(true))->Solve(fit, {}, {});
    EXPECT_EQ(report.termination, Termination::kConverged) << report.message;
    EXPECT_GE(FewerDigits(report.x), 10) << name;
    EXPECT_NEAR(2 * report.objective, Misra1aFit::kResidualSumOfSquares, 1e-10);
    EXPECT_DOUBLE_EQ(report.objective, fit.Objective(report.x));
  }
}

TEST(Refinement, FromNearTheSolution_FindsTheDigitsItself) {
  const Misra1aFit fit;
  LeastSquares least_squares(fit, 1);
  least_squares.SetX(std::vector<double>{Misra1aFit::kB1 * (1 + 1e-6), Misra1aFit::kB2 * (1 - 1e-6)});
  EXPECT_TRUE(RefineByGaussNewton(least_squares.Cost(), &least_squares));
  EXPECT_GE(FewerDigits({least_squares.x()[0], least_squares.x()[1]}), 10);
}

TEST(Refinement, FromFarAway_DoesNotBegin) {
  const Misra1aFit fit;  // its start is 5 and 9 % away
  LeastSquares least_squares(fit, 1);
  EXPECT_FALSE(RefineByGaussNewton(least_squares.Cost(), &least_squares));
  EXPECT_EQ(least_squares.x()[0], 250);
  EXPECT_EQ(least_squares.x()[1], 0.0005);
  EXPECT_EQ(least_squares.counts().jacobian_evaluations, 1);
}

TEST(Refinement, OfAnExactSolution_LeavesIt) {
  const RosenbrockFit fit;
  LeastSquares least_squares(fit, 1);
  least_squares.SetX(std::vector<double>{1, 1});
  EXPECT_FALSE(RefineByGaussNewton(least_squares.Cost(), &least_squares));
  EXPECT_EQ(least_squares.x()[0], 1);
  EXPECT_EQ(least_squares.x()[1], 1);
  EXPECT_EQ(least_squares.counts().jacobian_evaluations, 1);
}

TEST(Refinement, CountsItsJacobians) {
  const Misra1aFit fit;
  LeastSquares least_squares(fit, 1);
  least_squares.SetX(std::vector<double>{Misra1aFit::kB1 * (1 + 1e-6), Misra1aFit::kB2});
  const double cost = least_squares.Cost();
  const std::int64_t before = fit.calls->jacobian;
  RefineByGaussNewton(cost, &least_squares);
  const std::int64_t made = fit.calls->jacobian - before;
  EXPECT_GE(made, 2);
  EXPECT_LE(made, 30);
  EXPECT_EQ(least_squares.counts().jacobian_evaluations, made);
  // Each is charged two parameters beside its residuals.
  EXPECT_EQ(least_squares.ChargedEvaluations(), least_squares.counts().residual_evaluations + 2 * made);
}

TEST(Refinement, InTheReport_IsCountedAsItsFunctorsAre) {
  const Misra1aFit plain_fit, refined_fit;
  const SolverReport plain = MakeSolver("lm", {})->Solve(plain_fit, {}, {});
  const SolverReport refined = MakeSolver("lm", {{"refine", true}})->Solve(refined_fit, {}, {});
  EXPECT_EQ(refined.jacobian_evaluations, refined_fit.calls->jacobian);
  EXPECT_GT(refined.jacobian_evaluations, plain.jacobian_evaluations);
  EXPECT_EQ(refined.evaluations, refined.residual_evaluations + 2 * refined.jacobian_evaluations);
  EXPECT_GT(FewerDigits(refined.x), FewerDigits(plain.x));
}

TEST(Refinement, OfALineThatIsSolved_KeepsItToTheRounding) {
  const LineFit fit;
  const SolverReport report = MakeSolver("lm", {{"refine", true}})->Solve(fit, {}, {});
  EXPECT_NEAR(report.x.at(0), 1.5, 1e-14);
  EXPECT_NEAR(report.x.at(1), 1, 1e-14);
  EXPECT_NEAR(report.objective, 0.5, 1e-14);
}

TEST(Refinement, WithConstantParameters_MovesTheOthersAlone) {
  Misra1aFit fit;
  fit.blocks[1].start = {Misra1aFit::kB2};
  fit.blocks[1].constant = true;
  const SolverReport report = MakeSolver("lm", ZeroTolerances(true))->Solve(fit, {}, {});
  EXPECT_EQ(report.x.at(1), Misra1aFit::kB2);
  EXPECT_GE(Digits(report.x.at(0), Misra1aFit::kB1), 10);
}

TEST(Refinement, WithBoundsOrManifolds_IsRefusedByName) {
  Misra1aFit bounded;
  bounded.blocks[1].lower = {0};
  const auto solve = [](const FitProblem& fit) {
    return MessageOf<ConfigError>([&] { MakeSolver("lm", {{"refine", true}})->Solve(fit, {}, {}); });
  };
  EXPECT_EQ(solve(bounded), "option 'refine' cannot hold bounds, and parameter 'b2' has some: leave it out");
  RosenbrockFit curved;
  curved.blocks[0].manifold = std::make_shared<ceres::SubsetManifold>(2, std::vector<int>{1});
  EXPECT_EQ(solve(curved), "option 'refine' cannot move parameter 'x', which lives on a manifold");
  bounded.blocks[1].lower = {-std::numeric_limits<double>::infinity()};  // none
  EXPECT_GE(FewerDigits(MakeSolver("lm", ZeroTolerances(true))->Solve(bounded, {}, {}).x), 10);
}

TEST(Refinement, OfAnotherObjective_IsRefused) {
  const MinimaxFit fit(3);
  EXPECT_EQ(MessageOf<ConfigError>([&] {
              MakeSolver("lm", {{"refine", true}})->Solve(fit, {}, {});
            }),
            "option 'refine' needs a fit whose objective is its sum of squares: leave it out");
}

TEST(Refinement, IntoNan_IsTakenBack) {
  const PartlyNanFit fit(1.0005, 1.0002);  // the step to 1 cannot be evaluated
  LeastSquares least_squares(fit, 1);
  EXPECT_FALSE(RefineByGaussNewton(least_squares.Cost(), &least_squares));
  EXPECT_EQ(least_squares.x()[0], 1.0005);
}

TEST(Refinement, AboveTheBestCost_IsTakenBack) {
  const Misra1aFit fit;
  LeastSquares least_squares(fit, 1);
  const std::vector<double> near = {Misra1aFit::kB1 * (1 + 1e-6), Misra1aFit::kB2};
  least_squares.SetX(near);
  EXPECT_FALSE(RefineByGaussNewton(Misra1aFit::kResidualSumOfSquares / 2 * (1 - 1e-6), &least_squares));
  EXPECT_EQ(least_squares.x()[0], near[0]);
}

TEST(Refinement, CutOffByTheBudgetAnywhere_LeavesAValidReport) {
  const Misra1aFit fit;
  const SolverReport plain = MakeSolver("lm", {})->Solve(fit, {}, {});
  const SolverReport refined = MakeSolver("lm", {{"refine", true}})->Solve(fit, {}, {});
  ASSERT_LT(plain.evaluations + 3, refined.evaluations);
  for (std::int64_t budget = plain.evaluations; budget <= refined.evaluations; ++budget) {
    const SolverReport cut =
        MakeSolver("lm", {{"refine", true}})->Solve(fit, {.max_evaluations = budget}, {});
    ASSERT_EQ(cut.x.size(), 2U);
    EXPECT_DOUBLE_EQ(cut.objective, fit.Objective(cut.x)) << budget;
    EXPECT_LE(cut.objective, plain.objective * (1 + 1e-9)) << budget;
    EXPECT_LE(cut.evaluations, budget + 2) << "an evaluation with its Jacobian, 3, begins below the budget";
    EXPECT_NE(cut.termination, Termination::kFailed);
    ASSERT_FALSE(cut.trace.empty());
    EXPECT_LE(cut.trace.back().evaluations, cut.evaluations);
  }
}

}  // namespace
}  // namespace frond
