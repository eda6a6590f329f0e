// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/run_length_distribution.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(RunLengthDistribution, StepsAtEachLengthByItsShareOfAllRuns) {
  const StepCurve curve = RunLengthDistribution(std::array{30.0, 10.0, kInfinity, 30.0, 70.0});
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_EQ(curve[0].x, 10);
  EXPECT_DOUBLE_EQ(curve[0].share, 0.2);
  EXPECT_EQ(curve[1].x, 30);
  EXPECT_DOUBLE_EQ(curve[1].share, 0.6);
  EXPECT_EQ(curve[2].x, 70);
  EXPECT_DOUBLE_EQ(curve[2].share, 0.8);
}

TEST(RunLengthDistribution, BetweenSteps_HoldsTheLastShare) {
  const StepCurve curve = RunLengthDistribution(std::array{30.0, 10.0, kInfinity, 30.0, 70.0});
  EXPECT_EQ(ShareAt(curve, 9.9), 0);
  EXPECT_DOUBLE_EQ(ShareAt(curve, 10), 0.2);
  EXPECT_DOUBLE_EQ(ShareAt(curve, 29.9), 0.2);
  EXPECT_DOUBLE_EQ(ShareAt(curve, 30), 0.6);
  EXPECT_DOUBLE_EQ(ShareAt(curve, 1e9), 0.8);
  EXPECT_DOUBLE_EQ(ShareAt(curve, kInfinity), 0.8);
}

TEST(RunLengthDistribution, WithoutSuccess_IsZeroEverywhere) {
  const StepCurve curve = RunLengthDistribution(std::array{kInfinity, kInfinity});
  EXPECT_TRUE(curve.empty());
  EXPECT_EQ(ShareAt(curve, kInfinity), 0);
}

TEST(RunLengthDistribution, OfSuccessesAlone_EndsAtExactlyOne) {
  EXPECT_EQ(RunLengthDistribution(std::array{3.0, 0.0, 8.0}).back().share, 1);
}

TEST(RunLengthDistribution, BrokenInput_Throws) {
  EXPECT_THROW(RunLengthDistribution({}), std::invalid_argument);
  EXPECT_THROW(RunLengthDistribution(std::array{1.0, -1.0}), std::invalid_argument);
  EXPECT_THROW(RunLengthDistribution(std::array{std::nan("")}), std::invalid_argument);
  EXPECT_THROW(EmpiricalDistribution(std::array{-kInfinity}), std::invalid_argument);
  EXPECT_THROW(ShareAt({}, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace frond
