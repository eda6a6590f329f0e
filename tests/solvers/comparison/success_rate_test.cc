// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/success_rate.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

TEST(WilsonInterval, MatchesNewcombesTable) {
  struct Row {
    std::int64_t successes, trials;
    double lower, upper;
  };
  // Newcombe (1998), table I, method 3.
  for (const Row& row : std::vector<Row>{{81, 263, 0.2553, 0.3662},
                                         {15, 148, 0.0624, 0.1605},
                                         {0, 20, 0.0000, 0.1611},
                                         {1, 29, 0.0061, 0.1718}}) {
    const Interval interval = WilsonInterval(row.successes, row.trials);
    EXPECT_NEAR(interval.lower, row.lower, 5e-5) << row.successes << "/" << row.trials;
    EXPECT_NEAR(interval.upper, row.upper, 5e-5) << row.successes << "/" << row.trials;
  }
}

TEST(WilsonInterval, EndsSolveTheScoreEquation) {
  // |p − p₀| = z √(p₀(1 − p₀)/n) at both ends p₀ (Wilson 1927), here with z = Φ⁻¹(0.995).
  const double z = 2.5758293035489004, p = 0.35, n = 20;
  const Interval interval = WilsonInterval(7, 20, 0.99);
  for (const double end : {interval.lower, interval.upper}) {
    EXPECT_NEAR((p - end) * (p - end), z * z * end * (1 - end) / n, 1e-14);
  }
}

TEST(WilsonInterval, OfFailures_MirrorsThatOfSuccesses) {
  for (std::int64_t successes = 0; successes <= 15; ++successes) {
    const Interval interval = WilsonInterval(successes, 15), mirrored = WilsonInterval(15 - successes, 15);
    EXPECT_NEAR(interval.lower, 1 - mirrored.upper, 1e-15);
    EXPECT_NEAR(interval.upper, 1 - mirrored.lower, 1e-15);
    EXPECT_LE(interval.lower, static_cast<double>(successes) / 15);
    EXPECT_GE(interval.upper, static_cast<double>(successes) / 15);
  }
}

TEST(WilsonInterval, OfNoneOrAll_ReachesTheEndExactly) {
  EXPECT_EQ(WilsonInterval(0, 15).lower, 0);
  EXPECT_EQ(WilsonInterval(15, 15).upper, 1);
}

TEST(WilsonInterval, BrokenCounts_Throw) {
  EXPECT_THROW(WilsonInterval(0, 0), std::invalid_argument);
  EXPECT_THROW(WilsonInterval(-1, 5), std::invalid_argument);
  EXPECT_THROW(WilsonInterval(6, 5), std::invalid_argument);
  EXPECT_THROW(WilsonInterval(1, 5, 1), std::invalid_argument);
}

}  // namespace
}  // namespace frond
