// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/fit_problem.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "solvers/fit_from.h"
#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

// Residual x − 3 that counts how often it is destroyed, added to three residual blocks of one problem.
struct CountedResidual {
  std::atomic<int>* destroyed;
  explicit CountedResidual(std::atomic<int>* count) : destroyed(count) {}
  CountedResidual(const CountedResidual&) = delete;
  CountedResidual& operator=(const CountedResidual&) = delete;
  ~CountedResidual() { ++*destroyed; }

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = x[0] - 3.0;
    return true;
  }
};

class SharedCostFit : public TestFit {
 public:
  SharedCostFit() {
    blocks = {{.name = "a", .start = {0}}, {.name = "b", .start = {1}}, {.name = "c", .start = {2}}};
  }
  void AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                    ceres::Problem* problem) const override {
    auto* cost = new ceres::AutoDiffCostFunction<CountedResidual, 1, 1>(new CountedResidual(&destroyed));
    for (double* value : values) problem->AddResidualBlock(cost, nullptr, value);
  }
  mutable std::atomic<int> destroyed{0};
};

// A fit whose residual is prepared by its state, as a distance fit's is: r = x₀ + x₁.
class StatefulFit : public TestFit {
 public:
  struct State : ceres::EvaluationCallback {
    std::vector<double*> blocks;
    int threads = 0;
    int notified = 0, new_points = 0, with_jacobians = 0;
    double sum = 0;
    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
      ++notified;
      new_points += new_evaluation_point ? 1 : 0;
      with_jacobians += evaluate_jacobians ? 1 : 0;
      sum = blocks[0][0] + blocks[1][0];
    }
  };
  struct SumOfState : ceres::SizedCostFunction<1, 1, 1> {
    const State* state;
    explicit SumOfState(const State* s) : state(s) {}
    bool Evaluate(double const* const* /*parameters*/, double* residual, double** jacobians) const override {
      residual[0] = state->sum;
      for (int b = 0; jacobians != nullptr && b < 2; ++b) {
        if (jacobians[b] != nullptr) jacobians[b][0] = 1;
      }
      return true;
    }
  };

  StatefulFit() { blocks = {{.name = "x0", .start = {2}}, {.name = "x1", .start = {3}}}; }
  std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& values,
                                                         int threads) const override {
    auto state = std::make_shared<State>();
    state->blocks = values;
    state->threads = threads;
    last_state = state;
    return state;
  }
  void AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override {
    problem->AddResidualBlock(new SumOfState(static_cast<State*>(state)), nullptr, values[0], values[1]);
  }
  mutable std::shared_ptr<State> last_state;
};

TEST(FitProblem, ParametersOfSeveralBlocks_AreOneFlatVector) {
  Misra1aFit fit;
  fit.blocks[1].constant = true;
  EXPECT_EQ(fit.NumParameters(), 2);
  EXPECT_EQ(fit.NumFreeParameters(), 1);
  EXPECT_EQ(fit.StartVector(), (std::vector<double>{250, 0.0005}));
}

TEST(FitProblem, DefaultObjective_IsHalfTheResidualSumOfSquares) {
  const Misra1aFit fit;
  const std::array<double, 2> certified = {Misra1aFit::kB1, Misra1aFit::kB2};
  EXPECT_NEAR(fit.Objective(certified), Misra1aFit::kResidualSumOfSquares / 2, 1e-11);
  EXPECT_TRUE(fit.ObjectiveIsLeastSquares());
  EXPECT_TRUE(fit.Metrics(certified).empty());
}

TEST(FitProblem, ObjectiveThatCannotBeEvaluated_IsNan) {
  const PartlyNanFit fit(2, 0);
  const double x = -1;
  EXPECT_TRUE(std::isnan(fit.Objective({&x, 1})));
}

TEST(FitProblem, Objective_IsReentrant) {
  const RosenbrockFit fit;
  std::vector<std::jthread> threads;
  threads.reserve(4);
  std::atomic<int> wrong{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 100; ++i) {
        const std::array<double, 2> x = {0.1 * t, 0.01 * i};
        const double expected = 0.5 * (100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2));
        if (std::abs(fit.Objective(x) - expected) > 1e-13 * (1 + expected)) ++wrong;
      }
    });
  }
  threads.clear();
  EXPECT_EQ(wrong, 0);
}

TEST(FitProblem, StartBoxOutOfOrder_IsRefusedByName) {
  const auto refusal = [](double lower, double upper) -> std::string {
    RosenbrockFit fit;
    SetBox(-5, 5, &fit);
    fit.blocks[0].start_lower = {0, lower};
    fit.blocks[0].start_upper = {1, upper};
    try {
      CheckParameters(fit);
    } catch (const FitError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(-5, 5), "accepted");
  EXPECT_EQ(refusal(3, 2),
            "parameter 'x'[1]: its start box [3, 2] is not a finite interval within the bounds [-5, 5]");
  EXPECT_EQ(refusal(0, HUGE_VAL),
            "parameter 'x'[1]: its start box [0, inf] is not a finite interval within the bounds [-5, 5]");
  EXPECT_EQ(refusal(0, 6), "parameter 'x'[1]: its start box [0, 6] is outside of its bounds [-5, 5]");
}

TEST(LeastSquares, SetX_MovesTheProblem) {
  const LineFit fit;
  LeastSquares least_squares(fit, 1);
  EXPECT_EQ(least_squares.x()[0], -3);
  least_squares.SetX(std::array<double, 2>{1.5, 1});
  EXPECT_NEAR(least_squares.Cost(), 0.5, 1e-14);
  EXPECT_THROW(least_squares.SetX(std::array<double, 1>{1}), std::invalid_argument);
}

TEST(LeastSquares, Evaluations_AreCountedAndChargedByParameters) {
  Misra1aFit fit;
  LeastSquares analytic(fit, 1);
  analytic.Cost();
  analytic.Cost();
  std::vector<double> gradient;
  analytic.problem().Evaluate({}, nullptr, nullptr, &gradient, nullptr);
  EXPECT_EQ(analytic.counts().residual_evaluations, 2);
  EXPECT_EQ(analytic.counts().jacobian_evaluations, 1);
  EXPECT_EQ(analytic.ChargedEvaluations(), 2 + 2);

  fit.derivatives_charged = Derivatives::kNumeric;
  LeastSquares numeric(fit, 1);
  numeric.problem().Evaluate({}, nullptr, nullptr, &gradient, nullptr);
  EXPECT_EQ(numeric.ChargedEvaluations(), 4);

  fit.blocks[0].constant = true;
  LeastSquares half(fit, 1);
  half.problem().Evaluate({}, nullptr, nullptr, &gradient, nullptr);
  EXPECT_EQ(half.ChargedEvaluations(), 2);
}

TEST(LeastSquares, CostFunctionSharedByBlocks_IsDeletedOnce) {
  const SharedCostFit fit;
  {
    LeastSquares least_squares(fit, 1);
    EXPECT_DOUBLE_EQ(least_squares.Cost(), 0.5 * (9 + 4 + 1));
  }
  EXPECT_EQ(fit.destroyed, 1);
}

TEST(LeastSquares, BoundsManifoldsAndConstants_ReachTheProblem) {
  const double infinity = std::numeric_limits<double>::infinity();
  RosenbrockFit fit;
  fit.blocks[0].lower = {-2, -infinity};
  fit.blocks[0].upper = {infinity, 7};
  {
    LeastSquares least_squares(fit, 1);
    const double* x = least_squares.x().data();
    EXPECT_EQ(least_squares.problem().GetParameterLowerBound(x, 0), -2);
    EXPECT_EQ(least_squares.problem().GetParameterUpperBound(x, 1), 7);
    EXPECT_LT(least_squares.problem().GetParameterLowerBound(x, 1), -1e300);
    EXPECT_FALSE(least_squares.problem().IsParameterBlockConstant(x));
  }
  fit.blocks[0].constant = true;
  fit.blocks[0].lower = fit.blocks[0].upper = {};
  fit.blocks[0].manifold = std::make_shared<ceres::SubsetManifold>(2, std::vector<int>{1});
  {
    LeastSquares least_squares(fit, 1);
    const double* x = least_squares.x().data();
    EXPECT_TRUE(least_squares.problem().IsParameterBlockConstant(x));
    EXPECT_EQ(least_squares.problem().GetManifold(x), fit.blocks[0].manifold.get());
  }
  EXPECT_EQ(fit.blocks[0].manifold.use_count(), 1) << "the manifold is shared, not owned by the problem";
}

TEST(LeastSquares, State_IsToldOfEachEvaluationAtTheRightParameters) {
  const StatefulFit fit;
  LeastSquares least_squares(fit, 3);
  EXPECT_EQ(fit.last_state->threads, 3);
  EXPECT_DOUBLE_EQ(least_squares.Cost(), 12.5);
  least_squares.SetX(std::array<double, 2>{1, -4});
  EXPECT_DOUBLE_EQ(least_squares.Cost(), 4.5);
  EXPECT_EQ(fit.last_state->notified, 2);
  EXPECT_EQ(fit.last_state->with_jacobians, 0);

  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.linear_solver_type = ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &least_squares.problem(), &summary);
  EXPECT_NEAR(summary.final_cost, 0, 1e-9);
  EXPECT_EQ(fit.last_state->notified,
            least_squares.counts().residual_evaluations + least_squares.counts().jacobian_evaluations);
  EXPECT_EQ(fit.last_state->with_jacobians, least_squares.counts().jacobian_evaluations);
  EXPECT_LT(fit.last_state->new_points, fit.last_state->notified) << "accepted steps are evaluated twice";
}

std::string MessageOfCheck(const FitProblem& fit) {
  try {
    CheckParameters(fit);
  } catch (const FitError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CheckParameters, WrongBounds_AreNamed) {
  RosenbrockFit fit;
  EXPECT_EQ(MessageOfCheck(fit), "accepted");
  fit.blocks[0].lower = {0};
  EXPECT_EQ(MessageOfCheck(fit), "parameter 'x': 1 lower and 0 upper bounds for 2 values");
  SetBox(-1, 2, &fit);
  EXPECT_EQ(MessageOfCheck(fit), "parameter 'x'[0]: its start -1.2 is outside of its bounds [-1, 2]");
  fit.blocks[0].constant = true;  // held at its start, bounds or not
  EXPECT_EQ(MessageOfCheck(fit), "accepted");
  fit.blocks[0].constant = false;
  SetBox(2, -2, &fit);
  EXPECT_EQ(MessageOfCheck(fit), "parameter 'x'[0]: empty bounds [2, -2]");
  EXPECT_THROW(LeastSquares(fit, 1), FitError);
}

TEST(FitFrom, AnotherStart_ChangesNothingElse) {
  Misra1aFit fit;
  fit.blocks[1].constant = true;
  SetBox(0, 1000, &fit);
  const FitFrom moved(fit, std::array<double, 2>{100, 7});
  EXPECT_EQ(moved.StartVector(), (std::vector<double>{100, 0.0005})) << "a constant block stays";
  EXPECT_EQ(moved.parameters()[0].upper, fit.blocks[0].upper);
  EXPECT_EQ(moved.Objective(std::array<double, 2>{1, 2}), fit.Objective(std::array<double, 2>{1, 2}));
  EXPECT_THROW(FitFrom(fit, std::array<double, 1>{1}), std::invalid_argument);
}

}  // namespace
}  // namespace frond
