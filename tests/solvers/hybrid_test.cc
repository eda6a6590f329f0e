// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/hybrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/errors.h"
#include "solvers/option_prefix.h"
#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

using NamedOptions = std::vector<std::pair<std::string, OptionValue>>;

SolverReport Solve(const FitProblem& fit, const NamedOptions& options, const Budget& budget = {}) {
  return MakeSolver("pso_lm", options)->Solve(fit, budget, {.threads = 1, .seed = 3});
}

RosenbrockFit BoxedRosenbrock() {
  RosenbrockFit fit;
  SetBox(-5, 5, &fit);
  return fit;
}

TEST(PsoLm, OnBoxedRosenbrock_EndsAtLmPrecision) {
  const SolverReport report = Solve(BoxedRosenbrock(), {{"pso.iterations", 5}});
  EXPECT_LT(report.objective, 1e-15);
  EXPECT_EQ(report.termination, Termination::kConverged);
  EXPECT_EQ(report.message.substr(0, 29), "pso: iteration limit reached;");
}

TEST(PsoLm, LimitedEvaluations_AreSharedAsSet) {
  for (const double share : {0.25, 0.5}) {
    const SolverReport report =
        Solve(BoxedRosenbrock(), {{"pso_share", share}, {"pso.swarm_size", 10}}, {.max_evaluations = 400});
    // The descent joins the trace where the swarm's share ends: its start costs a residual-and-Jacobian.
    const std::int64_t swarm = std::llround(share * 400);
    bool joined = false;
    for (const TracePoint& point : report.trace) joined |= point.evaluations == swarm + 2;
    EXPECT_TRUE(joined) << share;
  }
}

TEST(PsoLm, CountsAndTrace_AreJoined) {
  const RosenbrockFit fit = BoxedRosenbrock();
  const SolverReport report = Solve(fit, {{"pso.swarm_size", 10}, {"pso.iterations", 5}});
  EXPECT_GT(report.jacobian_evaluations, 0);
  EXPECT_GT(report.residual_evaluations, 60);
  EXPECT_EQ(report.evaluations, report.residual_evaluations + 2 * report.jacobian_evaluations);
  EXPECT_GT(report.iterations, 5);
  for (std::size_t i = 1; i < report.trace.size(); ++i) {
    EXPECT_GE(report.trace[i].evaluations, report.trace[i - 1].evaluations);
    EXPECT_GE(report.trace[i].seconds, report.trace[i - 1].seconds);
    EXPECT_LE(report.trace[i].best_objective, report.trace[i - 1].best_objective);
  }
}

TEST(PsoLm, LmWorseByTheObjective_KeepsTheSwarmsResult) {
  MinimaxFit fit(0, /*agree=*/false);  // the objective is least at 1, least squares at 2
  SetBox(-10, 10, &fit);
  const SolverReport report = Solve(fit, {{"pso.iterations", 60}});
  EXPECT_NEAR(report.x[0], 1, 1e-3);
  EXPECT_DOUBLE_EQ(report.objective, fit.Objective(report.x));
}

TEST(PsoLm, TargetMetBySwarm_NeedsNoLm) {
  const SolverReport report = Solve(BoxedRosenbrock(), {}, {.target_objective = 1e6});
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_EQ(report.jacobian_evaluations, 0);
}

TEST(PsoLm, WholeShareForTheSwarm_LeavesNothingForLm) {
  const SolverReport report = Solve(BoxedRosenbrock(), {{"pso_share", 1}}, {.max_evaluations = 100});
  EXPECT_EQ(report.evaluations, 100);
  EXPECT_EQ(report.termination, Termination::kEvaluationBudget);
}

TEST(PsoLm, LmRefineOfABoundedFit_IsRefusedBeforeTheSwarmRuns) {
  for (const char* name : {"pso_lm", "multistart_lm"}) {
    const RosenbrockFit fit = BoxedRosenbrock();
    EXPECT_THROW(MakeSolver(name, {{"lm.refine", true}})->Solve(fit, {}, {}), ConfigError) << name;
    EXPECT_EQ(fit.calls->residual, 0) << name;
  }
}

TEST(PsoLm, Check_IsThatOfBoth) {
  EXPECT_THROW(MakeSolver("pso_lm")->Check(RosenbrockFit()), ConfigError) << "no box to start in";
  EXPECT_THROW(MakeSolver("pso_lm", {{"lm.refine", true}})->Check(BoxedRosenbrock()), ConfigError);
  EXPECT_NO_THROW(MakeSolver("pso_lm")->Check(BoxedRosenbrock()));
}

TEST(PsoLm, TargetMetByLm_NeedsNoOtherEvaluation) {
  const RosenbrockFit fit = BoxedRosenbrock();
  const SolverReport report = Solve(fit, {{"pso.iterations", 2}}, {.target_objective = 1e-9});
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_GT(report.jacobian_evaluations, 0);
  EXPECT_EQ(report.trace.back().evaluations, report.evaluations);
  EXPECT_EQ(fit.calls->residual, report.residual_evaluations);
}

TEST(PsoLm, LmAtItsIterationLimit_IsNoBudgetUsedUp) {
  const SolverReport report =
      Solve(BoxedRosenbrock(), {{"pso.swarm_size", 10}, {"lm.max_iterations", 1}}, {.max_evaluations = 400});
  EXPECT_EQ(report.termination, Termination::kIterationLimit) << report.message;
}

TEST(PsoLm, UnknownSubOption_ThrowsWithNearest) {
  Options options(PsoLmSolverType().options);
  try {
    options.Set("pso.swarm_sise", 5);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "unknown option 'pso.swarm_sise' (did you mean 'pso.swarm_size'?)");
  }
  EXPECT_THROW(options.Set("lm.max_iterations", -1), ConfigError);
}

TEST(OptionPrefix, ThereAndBack_KeepsValuesSet) {
  const std::vector<OptionSpec> specs = {
      {.name = "n", .type = OptionType::kInteger, .default_value = 4, .help = "n"},
      {.name = "kind", .type = OptionType::kText, .default_value = std::string("a"), .help = "kind"}};
  Options outer(WithPrefix("inner", specs));
  outer.Set("inner.n", 9);
  const Options inner = WithoutPrefix("inner", specs, outer);
  EXPECT_EQ(inner.Integer("n"), 9);
  EXPECT_TRUE(inner.IsSet("n"));
  EXPECT_EQ(inner.Text("kind"), "a");
  EXPECT_FALSE(inner.IsSet("kind"));
}

}  // namespace
}  // namespace frond
