// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/profiles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void ExpectCurve(const StepCurve& curve, const StepCurve& expected) {
  ASSERT_EQ(curve.size(), expected.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_DOUBLE_EQ(curve[i].x, expected[i].x);
    EXPECT_DOUBLE_EQ(curve[i].share, expected[i].share);
  }
}

TEST(PerformanceProfiles, OfThreeProblemsAndTwoSolvers_MatchHandCalculation) {
  const auto profiles = PerformanceProfiles({{1, 2}, {4, 2}, {kInfinity, 3}});
  ASSERT_EQ(profiles.size(), 2U);
  ExpectCurve(profiles[0], {{1, 1.0 / 3}, {2, 2.0 / 3}});  // ratios 1, 2, ∞
  ExpectCurve(profiles[1], {{1, 2.0 / 3}, {2, 1}});        // ratios 2, 1, 1
}

TEST(PerformanceProfiles, TiedSolvers_BothCountAsBest) {
  const auto profiles = PerformanceProfiles({{5, 5}, {5, 10}});
  EXPECT_EQ(ShareAt(profiles[0], 1), 1);
  EXPECT_EQ(ShareAt(profiles[1], 1), 0.5);
}

TEST(PerformanceProfiles, ProblemThatNobodySolved_CountsForNobodyInTheDenominator) {
  const auto profiles = PerformanceProfiles({{1, 3}, {kInfinity, kInfinity}});
  ExpectCurve(profiles[0], {{1, 0.5}});
  ExpectCurve(profiles[1], {{3, 0.5}});
}

TEST(PerformanceProfiles, OfASolverThatAlwaysFails_IsEmpty) {
  EXPECT_TRUE(PerformanceProfiles({{1, kInfinity}, {2, kInfinity}})[1].empty());
}

TEST(PerformanceProfiles, DoNotDependOnTheUnitOfAProblem) {
  const auto profiles = PerformanceProfiles({{3, 7, 5}, {11, 2, kInfinity}});
  const auto scaled = PerformanceProfiles({{3 * 64, 7 * 64, 5 * 64}, {11.0 / 8, 2.0 / 8, kInfinity}});
  for (std::size_t solver = 0; solver < 3; ++solver) ExpectCurve(scaled[solver], profiles[solver]);
}

TEST(DataProfiles, OfThreeProblemsAndTwoSolvers_MatchHandCalculation) {
  const auto profiles =
      DataProfiles({{4, 2}, {8, kInfinity}, {kInfinity, 3}}, std::array<std::int64_t, 3>{1, 3, 2});
  ASSERT_EQ(profiles.size(), 2U);
  ExpectCurve(profiles[0], {{2, 2.0 / 3}});  // 4/2, 8/4, ∞
  ExpectCurve(profiles[1], {{1, 2.0 / 3}});  // 2/2, ∞, 3/3
}

TEST(DataProfiles, OfASingleSolver_DoNotDependOnItsPeers) {
  const std::array<std::int64_t, 2> counts{4, 9};
  const auto alone = DataProfiles({{10}, {80}}, counts);
  const auto together = DataProfiles({{10, 1}, {80, kInfinity}}, counts);
  ExpectCurve(together[0], alone[0]);
}

TEST(Profiles, BrokenTables_Throw) {
  EXPECT_THROW(PerformanceProfiles({}), std::invalid_argument);
  EXPECT_THROW(PerformanceProfiles({{}}), std::invalid_argument);
  EXPECT_THROW(PerformanceProfiles({{1, 2}, {1}}), std::invalid_argument);
  EXPECT_THROW(PerformanceProfiles({{1, std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(PerformanceProfiles({{1, 0}}), std::invalid_argument);
  EXPECT_THROW(PerformanceProfiles({{1, -kInfinity}}), std::invalid_argument);
  EXPECT_THROW(DataProfiles({{1, 2}}, {}), std::invalid_argument);
  EXPECT_THROW(DataProfiles({{1, 2}}, std::array<std::int64_t, 1>{0}), std::invalid_argument);
  EXPECT_THROW(DataProfiles({{1, -2}}, std::array<std::int64_t, 1>{3}), std::invalid_argument);
}

}  // namespace
}  // namespace frond
