// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/multiple_comparisons.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

TEST(HolmAdjusted, MatchesHandCalculation) {
  // .005 · 4, .01 · 3, .03 · 2, and .04 · 1 raised to its forerunner's .06.
  const std::vector<double> adjusted = HolmAdjusted(std::array{0.01, 0.04, 0.03, 0.005});
  const std::array expected{0.03, 0.06, 0.06, 0.02};
  ASSERT_EQ(adjusted.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], expected[i]);
}

TEST(HolmAdjusted, OfDemsarsExample_RejectsWhatHeRejects) {
  // Demšar (2006), section 3.2.2: p = .016, .019, .607 against .017, .025, .05. He rejects the first two.
  const std::vector<double> adjusted = HolmAdjusted(std::array{0.607, 0.016, 0.019});
  EXPECT_DOUBLE_EQ(adjusted[1], 0.048);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.048);  // .019 · 2 is less than its forerunner
  EXPECT_DOUBLE_EQ(adjusted[0], 0.607);
}

TEST(HolmAdjusted, IsAtMostOneAndKeepsTheOrderOfSignificance) {
  const std::array p_values{0.9, 0.5, 0.2, 0.6, 0.0, 1.0};
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    EXPECT_GE(adjusted[i], p_values[i]);
    EXPECT_LE(adjusted[i], 1);
    for (std::size_t j = 0; j < p_values.size(); ++j) {
      if (p_values[i] <= p_values[j]) {
        EXPECT_LE(adjusted[i], adjusted[j]);
      }
    }
  }
  EXPECT_EQ(adjusted[4], 0);
}

TEST(HolmAdjusted, OfOneOrNone_ChangesNothing) {
  EXPECT_EQ(HolmAdjusted(std::array{0.3}), std::vector<double>{0.3});
  EXPECT_TRUE(HolmAdjusted({}).empty());
}

TEST(HolmAdjusted, OutsideUnitInterval_Throws) {
  EXPECT_THROW(HolmAdjusted(std::array{0.5, 1.1}), std::invalid_argument);
  EXPECT_THROW(HolmAdjusted(std::array{std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace frond
