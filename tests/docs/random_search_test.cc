// SPDX-License-Identifier: BSD-3-Clause
// The solver of docs/add_a_solver.md keeps the contract that the document tells.
#include "docs/examples/random_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/errors.h"
#include "problems/standard/problem_set.h"

namespace frond {
namespace {

std::shared_ptr<const FitProblem> Rosenbrock() {
  const ProblemSetType& set = FindProblemSetType(StandardSetTypes(), "functions");
  Options options(set.options);
  options.Set("function", std::string("rosenbrock"));
  options.Set("dimension", std::int64_t{2});
  return set.problems(options).at(0).make();
}

std::unique_ptr<Solver> MakeRandomSearch(std::int64_t samples) {
  const SolverType type = RandomSearchSolverType();
  Options options(type.options);
  options.Set("samples", samples);
  return type.create(options);
}

SolverReport Solve(std::int64_t samples, const Budget& budget, const SolveContext& context = {}) {
  return MakeRandomSearch(samples)->Solve(*Rosenbrock(), budget, context);
}

TEST(RandomSearchExample, OnRosenbrock_IsNeverWorseThanTheStart_AndComesNearTheMinimum) {
  const auto fit = Rosenbrock();
  const double start = fit->Objective(fit->StartVector());
  EXPECT_EQ(Solve(1, {}).objective, start);  // its first point is the fit's start
  const SolverReport report = Solve(100000, {});
  // f < 1 holds on an area of pi / 10 of the box of 60 x 60: about 9 of the points.
  EXPECT_LT(report.objective, 1);
  EXPECT_EQ(report.objective, fit->Objective(report.x));
  EXPECT_EQ(report.termination, Termination::kIterationLimit);
  EXPECT_EQ(report.evaluations, 100000);
}

TEST(RandomSearchExample, Budget_IsKeptToTheEvaluation) {
  for (const std::int64_t budget : {1, 63, 64, 65, 500}) {
    const SolverReport report = Solve(1000, {.max_evaluations = budget});
    EXPECT_EQ(report.evaluations, budget);
    EXPECT_EQ(report.residual_evaluations, budget);
    EXPECT_EQ(report.termination, Termination::kEvaluationBudget);
  }
  const double reachable = 50;
  const SolverReport report = Solve(1000000, {.target_objective = reachable});
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_LE(report.objective, reachable);
  EXPECT_EQ(Solve(1000000000, {.max_seconds = 0.01}).termination, Termination::kTimeBudget);
  EXPECT_EQ(Solve(1000000, {.stall_evaluations = 500}).termination, Termination::kStalled);
}

TEST(RandomSearchExample, SameSeed_GivesTheSameBitsForAnyThreads) {
  const SolverReport one = Solve(2000, {}, {.threads = 1, .seed = 7});
  const SolverReport two = Solve(2000, {}, {.threads = 2, .seed = 7});
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.objective, two.objective);
  EXPECT_EQ(one.evaluations, two.evaluations);
  ASSERT_EQ(one.trace.size(), two.trace.size());
  for (std::size_t k = 0; k < one.trace.size(); ++k) {
    EXPECT_EQ(one.trace[k].evaluations, two.trace[k].evaluations);
    EXPECT_EQ(one.trace[k].best_objective, two.trace[k].best_objective);
  }
  EXPECT_NE(one.x, Solve(2000, {}, {.threads = 1, .seed = 8}).x);
}

TEST(RandomSearchExample, StartBox_IsWhereItsPointsAre) {
  const SolverType type = RandomSearchSolverType();
  Options options(type.options);
  options.Set("start_box", std::vector<double>{0.9, 1.1});  // about the minimum
  const SolverReport report = type.create(options)->Solve(*Rosenbrock(), {}, {});
  for (const double x : report.x) EXPECT_NEAR(x, 1, 0.1);
  EXPECT_THROW(options.Set("sample", std::int64_t{3}), ConfigError);
  EXPECT_THROW(options.Set("samples", std::int64_t{0}), ConfigError);
}

// All parameters held.
class ConstantFit final : public FitProblem {
 public:
  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>&, ceres::EvaluationCallback*, ceres::Problem*) const override {
    throw std::logic_error("not asked for");
  }
  double Objective(std::span<const double> x) const override { return x[0]; }

 private:
  std::vector<ParameterBlock> parameters_ = {{.name = "x", .start = {3}, .constant = true}};
};

TEST(RandomSearchExample, OfAllConstantParameters_EvaluatesTheStart) {
  const SolverReport report = MakeRandomSearch(10)->Solve(ConstantFit(), {}, {});
  EXPECT_EQ(report.x, std::vector<double>{3});
  EXPECT_EQ(report.objective, 3);
}

}  // namespace
}  // namespace frond
