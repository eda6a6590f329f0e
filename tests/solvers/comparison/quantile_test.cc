// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/quantile.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Quantile, IsTypeSevenOfR) {
  // R: quantile(c(3, 1, 4, 1.5, 9, 2.6), c(0, .1, .25, .5, .75, .9, 1)); numpy.quantile of NumPy 1.24.2
  // agrees.
  const std::array<double, 6> values{3, 1, 4, 1.5, 9, 2.6};
  EXPECT_DOUBLE_EQ(Quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.1), 1.25);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.25), 1.775);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.5), 2.8);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.75), 3.75);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.9), 6.5);
  EXPECT_DOUBLE_EQ(Quantile(values, 1), 9);
  EXPECT_DOUBLE_EQ(SampleMedian(values), 2.8);
}

TEST(SampleQuartiles, AreTheQuantilesAtTheQuarters) {
  const std::array<double, 5> values{50, 10, 30, 20, 40};
  const Quartiles quartiles = SampleQuartiles(values);
  EXPECT_EQ(quartiles.lower, 20);
  EXPECT_EQ(quartiles.median, 30);
  EXPECT_EQ(quartiles.upper, 40);
}

TEST(Quantile, BesideInfinity_IsInfiniteNeverNaN) {
  const std::array<double, 4> half_failed{1, kInfinity, 2, kInfinity};
  EXPECT_DOUBLE_EQ(Quantile(half_failed, 0.25), 1.75);
  EXPECT_EQ(SampleMedian(half_failed), kInfinity);
  EXPECT_EQ(Quantile(half_failed, 0.9), kInfinity);
  EXPECT_EQ(SampleMedian(std::array{kInfinity, kInfinity}), kInfinity);
  EXPECT_EQ(SampleMedian(std::array{-kInfinity, 3.0}), -kInfinity);
  EXPECT_EQ(SampleMedian(std::array{-kInfinity, kInfinity}), kInfinity);
}

TEST(Quantile, AtAnOrderStatisticBeforeInfinity_IsThatStatistic) {
  // 100 · 0.07 is 7.000000000000001 in doubles.
  std::vector<double> values(101, kInfinity);
  for (std::size_t i = 0; i <= 7; ++i) values[i] = static_cast<double>(i);
  EXPECT_EQ(Quantile(values, 0.07), 7);
}

TEST(Quantile, OfOneValue_IsThatValue) {
  for (const double p : {0.0, 0.3, 1.0}) EXPECT_EQ(Quantile(std::array{4.5}, p), 4.5);
}

TEST(Quantile, BrokenInput_Throws) {
  EXPECT_THROW(Quantile({}, 0.5), std::invalid_argument);
  EXPECT_THROW(Quantile(std::array{1.0, std::nan("")}, 0.5), std::invalid_argument);
  EXPECT_THROW(Quantile(std::array{1.0}, 1.5), std::invalid_argument);
}

}  // namespace
}  // namespace frond
