// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/expected_running_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ExpectedRunningTime, ChargesFailuresToTheSuccesses) {
  EXPECT_DOUBLE_EQ(ExpectedRunningTime(std::vector<RunLength>{{100, true}, {200, false}, {300, true}}), 300);
  EXPECT_DOUBLE_EQ(ExpectedRunningTime(std::vector<RunLength>{{100, true}, {400, true}}), 250);
}

TEST(ExpectedRunningTime, WithoutSuccess_IsInfinite) {
  EXPECT_EQ(ExpectedRunningTime(std::vector<RunLength>{{100, false}, {100, false}}), kInfinity);
}

TEST(ExpectedRunningTime, DoesNotDependOnTheOrderOfRuns) {
  std::vector<RunLength> runs{{10, true}, {70, false}, {35, true}, {70, false}, {4, true}};
  const double expected = ExpectedRunningTime(runs);
  for (int i = 0; i < 5; ++i) {
    std::rotate(runs.begin(), runs.begin() + 2, runs.end());
    EXPECT_EQ(ExpectedRunningTime(runs), expected);
  }
}

TEST(ExpectedRunningTime, OfSimulatedRestarts_IsTheirMean) {
  // A run succeeds with probability 0.3 after 40 evaluations or fails after 100, so that a success costs
  // 40 + 100 · 0.7/0.3 evaluations on average.
  Random random(3);
  std::vector<RunLength> runs(40000);
  for (RunLength& run : runs) run = random.Uniform() < 0.3 ? RunLength{40, true} : RunLength{100, false};
  EXPECT_NEAR(ExpectedRunningTime(runs), 40 + 100 * 0.7 / 0.3, 8);
}

TEST(ExpectedRunningTimeInterval, HoldsTheExpectedRunningTime) {
  const std::vector<RunLength> runs{{10, true}, {20, true}, {30, true},  {90, false}, {25, true},
                                    {15, true}, {40, true}, {90, false}, {35, true},  {5, true}};
  Random random(5);
  const Interval interval = ExpectedRunningTimeInterval(runs, &random);
  EXPECT_LT(interval.lower, ExpectedRunningTime(runs));
  EXPECT_GT(interval.upper, ExpectedRunningTime(runs));
  EXPECT_LT(interval.upper, kInfinity);
}

TEST(ExpectedRunningTimeInterval, OfFewSuccesses_IsInfiniteAbove) {
  // (2/3)³ = 30 % of the resamples hold no success, 1/27 nothing else.
  Random random(5);
  const std::vector<RunLength> runs{{50, true}, {100, false}, {100, false}};
  const Interval interval = ExpectedRunningTimeInterval(runs, &random);
  EXPECT_DOUBLE_EQ(interval.lower, 50);
  EXPECT_EQ(interval.upper, kInfinity);
}

TEST(ExpectedRunningTime, BrokenRuns_Throw) {
  Random random(5);
  EXPECT_THROW(ExpectedRunningTime({}), std::invalid_argument);
  EXPECT_THROW(ExpectedRunningTimeInterval({}, &random), std::invalid_argument);
  for (const double evaluations : {-1.0, kInfinity, std::nan("")}) {
    EXPECT_THROW(ExpectedRunningTime(std::vector<RunLength>{{evaluations, true}}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace frond
