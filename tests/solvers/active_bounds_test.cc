// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/active_bounds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

TEST(ActiveBounds, CornerThatIsNoMinimum_IsLeft) {
  RosenbrockFit fit;
  SetBox(-2, 0.5, &fit);
  fit.blocks[0].start = {0.5, 0.5};  // Ceres alone stays here: its step to (1, 1) is cut to nothing
  for (const char* name : {"lm", "dogleg"}) {
    const SolverReport report = MakeSolver(name)->Solve(fit, {}, {});
    EXPECT_EQ(report.x[0], 0.5) << name;
    EXPECT_NEAR(report.x[1], 0.25, 1e-7) << name;
    EXPECT_EQ(report.termination, Termination::kConverged) << report.message;
  }
}

TEST(ActiveBounds, MinimumInACorner_IsConverged) {
  LineFit fit;  // its minimum (1.5, 1) is beyond both bounds
  fit.blocks[0].lower = {2, 2};
  fit.blocks[0].upper = {9, 9};
  fit.blocks[0].start = {5, 6};
  const SolverReport report = MakeSolver("lm")->Solve(fit, {}, {});
  EXPECT_EQ(report.x, (std::vector<double>{2, 2}));
  EXPECT_EQ(report.termination, Termination::kConverged);
}

TEST(ActiveBounds, ValueHeldTooEarly_IsReleased) {
  RosenbrockFit fit;
  SetBox(-2, 2, &fit);
  LeastSquares least_squares(fit, 1);
  ActiveBounds bounds(fit, &least_squares);
  least_squares.SetX(std::array<double, 2>{-1, 2});  // y = 2 wants to go down: ∂/∂y = 100 (y − x²) > 0
  EXPECT_FALSE(bounds.Update());
  least_squares.SetX(std::array<double, 2>{-1.5, 2});  // y = 2 is pushed up
  EXPECT_TRUE(bounds.Update());
  EXPECT_FALSE(bounds.Update()) << "nothing has changed since";
  EXPECT_EQ(least_squares.problem().ParameterBlockTangentSize(least_squares.x().data()), 1);
  least_squares.SetX(std::array<double, 2>{-1, 2});
  EXPECT_TRUE(bounds.Update());
  EXPECT_EQ(least_squares.problem().ParameterBlockTangentSize(least_squares.x().data()), 2);
}

TEST(ActiveBounds, NothingAtABound_CostsNoEvaluation) {
  RosenbrockFit fit;
  SetBox(-5, 5, &fit);
  LeastSquares least_squares(fit, 1);
  EXPECT_FALSE(ActiveBounds(fit, &least_squares).Update());
  EXPECT_EQ(least_squares.counts().jacobian_evaluations, 0);
}

TEST(ActiveBounds, WholeBlockActive_IsHeldAsAConstant) {
  LineFit fit;
  fit.blocks[0].lower = {2, 2};
  fit.blocks[0].start = {2, 2};
  LeastSquares least_squares(fit, 1);
  ActiveBounds bounds(fit, &least_squares);
  EXPECT_TRUE(bounds.Update());
  EXPECT_TRUE(least_squares.problem().IsParameterBlockConstant(least_squares.x().data()));
  least_squares.SetX(std::array<double, 2>{2, 5});
  EXPECT_TRUE(bounds.Update());
  EXPECT_FALSE(least_squares.problem().IsParameterBlockConstant(least_squares.x().data()));
}

}  // namespace
}  // namespace frond
