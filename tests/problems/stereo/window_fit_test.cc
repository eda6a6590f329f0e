// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/errors.h"
#include "problems/stereo/window_matcher.h"
#include "window_case.h"

namespace frond {
namespace {

std::unique_ptr<Solver> Create(const std::string& name) {
  const SolverType& type = FindSolverType(name);
  return type.create(Options(type.options));
}

TEST(WindowFit, EverySolverOfTheStudy_FindsTheMatchersWindow) {
  const WindowCase with({});
  const WindowMatcher matcher(with.pair.left, with.all, with.right, with.all, {});
  const double truth = with.Truth(100, 60);
  const WindowMatch best = matcher.Match(100, 60, {truth + 0.3});
  for (const char* name : {"lm", "multistart_lm", "pso_lm"}) {
    const WindowMatch match = SolveWindow(with.images(), {}, 100, 60, {truth + 0.3}, {.start_box = 1},
                                          *Create(name), {.max_evaluations = 4000}, {.seed = 1});
    ASSERT_TRUE(match.converged) << name;
    EXPECT_NEAR(match.warp[0], best.warp[0], 1e-4) << name;
    EXPECT_NEAR(match.sigma, best.sigma, 1e-3 * best.sigma) << name;
    EXPECT_GT(match.evaluations, 0) << name;
  }
  const WindowMatch swarm = SolveWindow(with.images(), {}, 100, 60, {truth + 0.3}, {.start_box = 1},
                                        *Create("pso"), {.max_evaluations = 20000}, {.seed = 1});
  EXPECT_NEAR(swarm.warp[0], best.warp[0], 0.02);
}

TEST(WindowFit, Objective_IsTheCostOfItsResidualBlocks) {
  const WindowCase with({});
  for (const RadiometryKind kind :
       {RadiometryKind::kNone, RadiometryKind::kGainOffset, RadiometryKind::kPlanarGain}) {
    const WindowFit fit(with.images(), {.radiometry = kind}, 100, 60, {20.2});
    EXPECT_EQ(fit.NumParameters(), 3 + RadiometrySize(kind));
    const std::vector<double> x = fit.StartVector();
    LeastSquares problem(fit, 1);
    EXPECT_NEAR(fit.Objective(x), problem.Cost(), 1e-9 * problem.Cost());
  }
}

TEST(WindowFit, Metrics_TellErrorAndSigma) {
  const WindowCase with({});
  const double truth = with.Truth(100, 60);
  const WindowFit fit(with.images(), {}, 100, 60, {truth + 0.25}, {.start_box = 1, .true_disparity = truth});
  const auto metrics = fit.Metrics(fit.StartVector());
  EXPECT_NEAR(metrics.at("disparity_error"), 0.25, 1e-12);
  EXPECT_NEAR(metrics.at("disparity"), truth + 0.25, 1e-12);
  EXPECT_GT(metrics.at("sigma"), 0);
}

TEST(WindowFit, OutsideOfTheImages_IsRefused) {
  const WindowCase with({});
  EXPECT_THROW(WindowFit(with.images(), {}, 5, 60, {20}), FitError);
}

}  // namespace
}  // namespace frond
