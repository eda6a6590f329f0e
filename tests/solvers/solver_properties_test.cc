// SPDX-License-Identifier: BSD-3-Clause
// What every registered solver must do, whatever its method: a new one is tested by being registered.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "solvers/solver.h"
#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

class EverySolver : public testing::TestWithParam<std::string> {
 protected:
  // Bounded for all but those that refuse bounds.
  bool TakesBounds() const { return GetParam() != "lbfgs" && GetParam() != "bfgs"; }

  template <typename Fit>
  Fit Boxed(Fit fit, double lower, double upper) const {
    if (TakesBounds()) SetBox(lower, upper, &fit);
    return fit;
  }

  SolverReport Solve(const FitProblem& fit, const Budget& budget, const SolveContext& context = {}) const {
    return MakeSolver(GetParam())->Solve(fit, budget, context);
  }

  // Enough for every method on two parameters, small enough for a test.
  static Budget Enough() { return {.max_evaluations = GetParam().starts_with("pagmo.") ? 40000 : 8000}; }

  // Bees settle slowly.
  static double Slack() { return GetParam() == "pagmo.bee_colony" ? 100 : 1; }
};

void ExpectSameResult(const SolverReport& a, const SolverReport& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.termination, b.termination);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.iterations, b.iterations);
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t i = 0; i < a.trace.size(); ++i) {
    EXPECT_EQ(a.trace[i].evaluations, b.trace[i].evaluations);
    EXPECT_EQ(a.trace[i].best_objective, b.trace[i].best_objective);
  }
}

TEST_P(EverySolver, SameSeed_GivesTheSameBitsForAnyThreads) {
  const RosenbrockFit fit = Boxed(RosenbrockFit(), -5, 5);
  for (const std::uint64_t seed : {1, 2}) {
    const SolverReport one = Solve(fit, Enough(), {.threads = 1, .seed = seed});
    ExpectSameResult(one, Solve(fit, Enough(), {.threads = 1, .seed = seed}));
    ExpectSameResult(one, Solve(fit, Enough(), {.threads = 2, .seed = seed}));
  }
}

TEST_P(EverySolver, OnRosenbrock_ReachesMinimum) {
  const SolverReport report = Solve(Boxed(RosenbrockFit(), -5, 5), Enough());
  EXPECT_NEAR(report.x[0], 1, 1e-3 * Slack()) << report.message;
  EXPECT_NEAR(report.x[1], 1, 2e-3 * Slack());
  EXPECT_NE(report.termination, Termination::kFailed);
}

TEST_P(EverySolver, OnLinearLeastSquares_ReachesMinimum) {
  const SolverReport report = Solve(Boxed(LineFit(), -10, 10), Enough());
  EXPECT_NEAR(report.x[0], 1.5, 1e-4 * Slack());
  EXPECT_NEAR(report.x[1], 1.0, 1e-4 * Slack());
  EXPECT_NEAR(report.objective, 0.5, 1e-7 * Slack() * Slack());
}

TEST_P(EverySolver, Report_HoldsTheObjectiveOfItsX) {
  const RosenbrockFit fit = Boxed(RosenbrockFit(), -5, 5);
  const SolverReport report = Solve(fit, {.max_evaluations = 60});
  EXPECT_NEAR(report.objective, fit.Objective(report.x), 1e-13 * (1 + report.objective));
}

TEST_P(EverySolver, Bounds_AreRespected) {
  if (!TakesBounds()) return;  // that they are refused then: ceres_solvers_test.cc
  // The minimum (1, 1) lies outside; every evaluation and the result stay inside.
  class Watched final : public RosenbrockFit {
   public:
    double Objective(std::span<const double> x) const override {
      outside = outside || x[0] < -2 || x[0] > 0.5 || x[1] < -2 || x[1] > 0.5;
      return RosenbrockFit::Objective(x);
    }
    mutable std::atomic<bool> outside{false};
  } fit;
  fit.blocks[0].start = {-1.2, 0.3};
  SetBox(-2, 0.5, &fit);
  const SolverReport report = Solve(fit, Enough());
  EXPECT_FALSE(fit.outside);
  for (const double x : report.x) {
    EXPECT_GE(x, -2);
    EXPECT_LE(x, 0.5);
  }
  EXPECT_NEAR(report.x[0], 0.5, 1e-3);
  EXPECT_NEAR(report.x[1], 0.25, 1e-3);
}

TEST_P(EverySolver, Target_EndsTheSolve) {
  const Budget budget{.max_evaluations = 8000, .target_objective = 0.5};
  const SolverReport report = Solve(Boxed(RosenbrockFit(), -5, 5), budget);
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_LE(report.objective, 0.5);
  EXPECT_LT(report.evaluations, 2000);
  // The trace holds the moment: all points before its last one are above the target.
  for (std::size_t i = 0; i + 1 < report.trace.size(); ++i) {
    if (report.trace[i].evaluations < report.trace.back().evaluations - 40) {
      EXPECT_GT(report.trace[i].best_objective, 0.5);
    }
  }
}

TEST_P(EverySolver, TargetMetAtTheStart_EndsTheSolveThere) {
  const SolverReport report = Solve(Boxed(RosenbrockFit(), -5, 5), {.target_objective = 1e9});
  EXPECT_EQ(report.termination, Termination::kTarget);
  EXPECT_LE(report.evaluations, 40);
}

TEST_P(EverySolver, EvaluationBudget_IsKept) {
  // Over it by less than an evaluation with its Jacobian of two parameters.
  constexpr std::int64_t kOver = 1;
  for (const std::int64_t budget : {1, 10, 33, 50, 200}) {
    const RosenbrockFit fit = Boxed(RosenbrockFit(), -5, 5);
    const SolverReport report = Solve(fit, {.max_evaluations = budget});
    EXPECT_LE(report.evaluations, std::max<std::int64_t>(budget + kOver, 2));
    EXPECT_TRUE(std::isfinite(report.objective));
    // In the trace: the point before the last was still within the budget.
    if (report.trace.size() > 1) {
      EXPECT_LT(report.trace[report.trace.size() - 2].evaluations, budget);
    }
    if (report.evaluations >= budget && report.termination != Termination::kConverged) {
      EXPECT_EQ(report.termination, Termination::kEvaluationBudget);
    }
  }
}

TEST_P(EverySolver, TimeBudget_IsKept) {
  class Slow final : public RosenbrockFit {
   public:
    Slow() { blocks[0].start = {-1.2, 1}; }
    std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& /*blocks*/,
                                                           int /*threads*/) const override {
      struct Sleep final : ceres::EvaluationCallback {
        void PrepareForEvaluation(bool /*jacobians*/, bool /*new_point*/) override {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
      };
      return std::make_shared<Sleep>();
    }
  };
  const Slow fit = Boxed(Slow(), -5, 5);
  const auto start = std::chrono::steady_clock::now();
  const SolverReport report = Solve(fit, {.max_seconds = 0.2});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(report.termination, Termination::kTimeBudget) << report.message;
  EXPECT_LT(seconds, 0.2 + 0.2);
  EXPECT_NEAR(report.seconds, seconds, 0.2);
}

TEST_P(EverySolver, Counts_EqualTheFunctorsOwn) {
  const RosenbrockFit fit = Boxed(RosenbrockFit(), -5, 5);
  const SolverReport report = Solve(fit, {.max_evaluations = 500});
  EXPECT_EQ(report.residual_evaluations, fit.calls->residual);
  EXPECT_EQ(report.jacobian_evaluations, fit.calls->jacobian);
  EXPECT_EQ(report.evaluations, report.residual_evaluations + 2 * report.jacobian_evaluations);
}

TEST_P(EverySolver, NumericJacobians_AreCountedAsTheyAre) {
  const NumericRosenbrockFit fit = Boxed(NumericRosenbrockFit(), -5, 5);
  const SolverReport report = Solve(fit, {.max_evaluations = 500});
  // Central differences call the functor at x and twice a parameter; the residuals at x come with the
  // Jacobian's charge.
  EXPECT_EQ(report.residual_evaluations + 5 * report.jacobian_evaluations, fit.calls->residual);
  EXPECT_EQ(report.evaluations, report.residual_evaluations + 4 * report.jacobian_evaluations);
}

TEST_P(EverySolver, WithoutProgress_Stalls) {
  RosenbrockFit fit = Boxed(RosenbrockFit(), -5, 5);
  fit.blocks[0].start = {1, 1};  // nothing is better
  const SolverReport report = Solve(fit, {.max_evaluations = 100000, .stall_evaluations = 300});
  EXPECT_TRUE(report.termination == Termination::kStalled || report.termination == Termination::kConverged)
      << TerminationName(report.termination);
  EXPECT_LE(report.evaluations, 300 + 45);
}

TEST_P(EverySolver, Start_IsNotWorsened) {
  for (const std::int64_t budget : {1, 20, 45}) {
    const Misra1aFit fit = Boxed(Misra1aFit(), 0, 1000);
    const SolverReport report = Solve(fit, {.max_evaluations = budget});
    EXPECT_LE(report.objective, fit.Objective(fit.StartVector()) * (1 + 1e-14)) << budget;
  }
}

TEST_P(EverySolver, Trace_DescendsToTheReport) {
  const SolverReport report = Solve(Boxed(RosenbrockFit(), -5, 5), Enough());
  ASSERT_FALSE(report.trace.empty());
  for (std::size_t i = 1; i < report.trace.size(); ++i) {
    EXPECT_GE(report.trace[i].evaluations, report.trace[i - 1].evaluations);
    EXPECT_GE(report.trace[i].seconds, report.trace[i - 1].seconds);
    EXPECT_LE(report.trace[i].best_objective, report.trace[i - 1].best_objective);
  }
  EXPECT_NEAR(report.trace.back().best_objective, report.objective, 1e-13 * report.objective);
  EXPECT_LE(report.trace.back().evaluations, report.evaluations);
}

TEST_P(EverySolver, NanEverywhere_FailsWithAMessage) {
  if (GetParam() == "nlopt.bobyqa") return;  // takes two parameters or more
  testing::internal::CaptureStderr();
  const SolverReport report = Solve(Boxed(PartlyNanFit(1, HUGE_VAL), -5, 5), {.max_evaluations = 500});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the cause belongs into the report alone";
  EXPECT_EQ(report.termination, Termination::kFailed);
  EXPECT_FALSE(report.message.empty());
  EXPECT_TRUE(std::isnan(report.objective));
  EXPECT_EQ(report.x, std::vector<double>{1});
}

TEST(Bobyqa, SingleParameter_IsRefusedByName) {
  PartlyNanFit fit(1, -10);
  SetBox(-5, 5, &fit);
  try {
    MakeSolver("nlopt.bobyqa")->Solve(fit, {}, {});
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "solver 'nlopt.bobyqa' needs two free parameters or more: use nlopt.nelder_mead");
  }
  EXPECT_EQ(fit.calls->residual, 0);
}

std::string RefusalOf(const std::string& solver,
                      const std::vector<std::pair<std::string, OptionValue>>& options,
                      const Budget& budget = {}) {
  RosenbrockFit fit;
  SetBox(-5, 5, &fit);
  try {
    MakeSolver(solver, options)->Solve(fit, budget, {});
  } catch (const ConfigError& error) {
    EXPECT_EQ(fit.calls->residual, 0);
    return error.what();
  }
  return "accepted";
}

TEST(Nlopt, NothingThatStopsIt_IsRefusedByName) {
  const std::vector<std::pair<std::string, OptionValue>> zero = {{"xtol", 0.0}, {"ftol", 0.0}};
  EXPECT_EQ(
      RefusalOf("nlopt.nelder_mead", zero, {.target_objective = 0}),
      "solver 'nlopt.nelder_mead' never stops with options 'xtol' and 'ftol' both 0 and no limit in the "
      "budget: set one");
  EXPECT_EQ(RefusalOf("nlopt.nelder_mead", zero, {.max_evaluations = 50}), "accepted");
}

TEST(Bobyqa, StepBeyondHalfTheBounds_IsRefusedByName) {
  EXPECT_EQ(
      RefusalOf("nlopt.bobyqa", {{"initial_step", 0.6}}),
      "option 'initial_step' of solver 'nlopt.bobyqa' is 0.6, longer than half of the bounds' width: set "
      "0.5 or less");
  EXPECT_EQ(RefusalOf("nlopt.bobyqa", {{"initial_step", 0.5}}), "accepted");
}

TEST(PagmoSwarms, NeighboursOfATopologyWithoutAny_AreRefusedByName) {
  for (const char* topology : {"gbest", "von_neumann"}) {
    EXPECT_EQ(RefusalOf("pagmo.pso_gen", {{"topology", std::string(topology)}, {"neighbours", 2}}),
              std::string("option 'neighbours' does not apply to 'topology: ") + topology + "'");
  }
}

TEST(PagmoSolvers, CutOffInTheFirstPopulation_CountNoIterations) {
  RosenbrockFit fit;
  SetBox(-5, 5, &fit);
  EXPECT_EQ(MakeSolver("pagmo.pso")->Solve(fit, {.max_evaluations = 10}, {}).iterations, 0);
}

TEST(PagmoSolvers, ExceptionsOfTheFit_AreItsOwn) {
  class Throwing final : public RosenbrockFit {
   public:
    double Objective(std::span<const double> x) const override {
      if (++evaluations > 60) throw std::invalid_argument("the fit's own");
      return RosenbrockFit::Objective(x);
    }
    mutable std::atomic<int> evaluations{0};
  };
  for (const char* name : {"pagmo.pso", "pagmo.pso_gen", "pagmo.cmaes"}) {
    Throwing fit;
    SetBox(-5, 5, &fit);
    try {
      MakeSolver(name)->Solve(fit, {}, {});
      FAIL() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), "the fit's own") << name;
    }
  }
}

TEST(CeresSolvers, TimeBudget_IncludesTheFitsState) {
  class SlowState final : public RosenbrockFit {
   public:
    std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& /*blocks*/,
                                                           int /*threads*/) const override {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return nullptr;
    }
  };
  const SolverReport report = MakeSolver("lm")->Solve(SlowState(), {.max_seconds = 0.04}, {});
  EXPECT_EQ(report.termination, Termination::kTimeBudget);
  EXPECT_GE(report.seconds, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Registered, EverySolver, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const SolverType& type : SolverTypes()) names.push_back(type.name);
                           return names;
                         }()),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace frond
