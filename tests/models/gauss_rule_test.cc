// SPDX-License-Identifier: BSD-3-Clause
#include "models/gauss_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace frond {
namespace {

TEST(GaussRule, OfNPoints_IsExactForPolynomialsUpToDegree2NMinus1) {
  for (int count = 1; count <= kMaxGaussPoints; ++count) {
    const GaussRule& rule = GaussRuleOf(count);
    ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(count));
    ASSERT_EQ(rule.weights.size(), static_cast<std::size_t>(count));
    const auto integral = [&](int power) {
      double sum = 0;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        sum += rule.weights[k] * std::pow(rule.nodes[k], power);
      }
      return sum;
    };
    for (int power = 0; power < 2 * count; ++power) {
      EXPECT_NEAR(integral(power), 1.0 / (power + 1), 1e-14) << count << " points, s^" << power;
    }
    // Of degree 2 n it misses by n!⁴ / ((2n + 1) (2n)!²) (Abramowitz and Stegun 25.4.29, on [0, 1]).
    if (count > 8) continue;
    const double ratio = std::exp(2 * std::lgamma(count + 1) - std::lgamma(2 * count + 1));
    EXPECT_NEAR(1.0 / (2 * count + 1) - integral(2 * count), ratio * ratio / (2 * count + 1), 1e-14);
  }
}

TEST(GaussRule, OfTwoPoints_IsTheKnownOne) {
  const GaussRule& rule = GaussRuleOf(2);
  EXPECT_NEAR(std::abs(rule.nodes[0] - 0.5), std::sqrt(1 / 12.0), 1e-15);
  EXPECT_NEAR(rule.nodes[0] + rule.nodes[1], 1, 1e-15);
  EXPECT_NEAR(rule.weights[0], 0.5, 1e-15);
}

}  // namespace
}  // namespace frond
