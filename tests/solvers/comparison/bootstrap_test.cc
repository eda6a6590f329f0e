// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ResampleStatistic MeanOf(const std::vector<double>& values) {
  return [&values](std::span<const std::size_t> indices) {
    double sum = 0;
    for (const std::size_t i : indices) sum += values[i];
    return sum / static_cast<double>(indices.size());
  };
}

TEST(Bootstrap, OfTheMeanOfNormals_HasTheWidthOfTheory) {
  Random random(20);
  std::vector<double> values(200);
  double sum = 0, squares = 0;
  for (double& value : values) {
    value = random.Normal();
    sum += value;
    squares += value * value;
  }
  const double mean = sum / 200, deviation = std::sqrt(squares / 200 - mean * mean);
  const Interval interval = BootstrapInterval(values.size(), MeanOf(values), &random);
  EXPECT_LT(interval.lower, mean);
  EXPECT_GT(interval.upper, mean);
  const double width = 2 * 1.96 * deviation / std::sqrt(200);
  EXPECT_NEAR(interval.upper - interval.lower, width, 0.15 * width);
}

TEST(Bootstrap, CoversTheTruthAboutAsOftenAsItSays) {
  Random random(21);
  constexpr int kSamples = 400;
  int covered = 0;
  std::vector<double> values(40);
  for (int i = 0; i < kSamples; ++i) {
    for (double& value : values) value = random.Normal();
    const Interval interval = BootstrapInterval(values.size(), MeanOf(values), &random, 0.9, 200);
    covered += interval.lower <= 0 && 0 <= interval.upper ? 1 : 0;
  }
  // The percentile interval of 40 values covers a little less than 90 %; four standard errors are 6 %.
  EXPECT_NEAR(covered / static_cast<double>(kSamples), 0.89, 0.06);
}

TEST(Bootstrap, OfTwoValues_HasTheQuantilesOfTheEnumeratedDistribution) {
  // The mean of a resample of {0, 1} is 0, 1/2 or 1 with probabilities 1/4, 1/2 and 1/4.
  const std::vector<double> values{0, 1};
  Random random(22);
  const Interval wide = BootstrapInterval(2, MeanOf(values), &random, 0.6);
  EXPECT_EQ(wide.lower, 0);
  EXPECT_EQ(wide.upper, 1);
  const Interval narrow = BootstrapInterval(2, MeanOf(values), &random, 0.4);
  EXPECT_EQ(narrow.lower, 0.5);
  EXPECT_EQ(narrow.upper, 0.5);
}

TEST(Bootstrap, SameSeed_GivesTheSameInterval) {
  const std::vector<double> values{3, 1, 4, 1, 5, 9, 2, 6};
  Random a(7), b(7), c(8);
  const Interval first = BootstrapInterval(values.size(), MeanOf(values), &a);
  const Interval second = BootstrapInterval(values.size(), MeanOf(values), &b);
  EXPECT_EQ(first.lower, second.lower);
  EXPECT_EQ(first.upper, second.upper);
  const Interval other = BootstrapInterval(values.size(), MeanOf(values), &c);
  EXPECT_NEAR(other.lower, first.lower, 0.5);
}

TEST(Bootstrap, OfInfiniteStatistics_SortsThemLast) {
  const std::vector<double> values{1, 2, 3, kInfinity};
  Random random(9);
  const Interval interval = BootstrapInterval(values.size(), MeanOf(values), &random);
  EXPECT_GE(interval.lower, 1);
  EXPECT_LT(interval.lower, 3);
  EXPECT_EQ(interval.upper, kInfinity);
}

TEST(Bootstrap, BrokenInput_Throws) {
  const std::vector<double> values{1, 2};
  Random random(1);
  EXPECT_THROW(BootstrapInterval(0, MeanOf(values), &random), std::invalid_argument);
  EXPECT_THROW(BootstrapInterval(2, MeanOf(values), nullptr), std::invalid_argument);
  EXPECT_THROW(BootstrapInterval(2, MeanOf(values), &random, 0), std::invalid_argument);
  EXPECT_THROW(BootstrapInterval(2, MeanOf(values), &random, 0.95, 0), std::invalid_argument);
  const auto undefined = [](std::span<const std::size_t>) { return std::nan(""); };
  EXPECT_THROW(BootstrapInterval(2, undefined, &random), std::invalid_argument);
}

}  // namespace
}  // namespace frond
