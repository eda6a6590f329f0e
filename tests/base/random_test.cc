// SPDX-License-Identifier: BSD-3-Clause
#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace frond {
namespace {

// Computed apart from this code, by tests/base/xoshiro_reference.py: splitmix64 (Vigna 2015) seeds the four
// words of xoshiro256++ 1.0 (Blackman and Vigna 2019).
TEST(Random, NextBits_MatchesReferenceGenerator) {
  struct Reference {
    std::uint64_t seed;
    std::array<std::uint64_t, 4> bits;
  };
  const std::vector<Reference> references = {
      {0U, {5987356902031041503U, 7051070477665621255U, 6633766593972829180U, 211316841551650330U}},
      {42U, {15021278609987233951U, 5881210131331364753U, 18149643915985481100U, 12933668939759105464U}},
      {18446744073709551615U,
       {6254647548650071986U, 16610832622747802512U, 16422857234328439435U, 5048281510058307187U}},
  };
  for (const Reference& reference : references) {
    Random random(reference.seed);
    for (const std::uint64_t bits : reference.bits) EXPECT_EQ(random.NextBits(), bits);
  }
}

TEST(Random, Uniform_LiesInHalfOpenUnitIntervalWithItsMoments) {
  Random random(7);
  constexpr int kDraws = 200000;
  double sum = 0, sum2 = 0, sum4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.Uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    const double c = u - 0.5;
    sum += c;
    sum2 += c * c;
    sum4 += c * c * c * c;
  }
  // Five standard errors: Var u = 1/12, Var c² = 1/180, Var c⁴ < E c⁸ = 1/2304 < 1e-3.
  EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NEAR(sum2 / kDraws, 1.0 / 12, 5 * std::sqrt(1.0 / 180 / kDraws));
  EXPECT_NEAR(sum4 / kDraws, 1.0 / 80, 5 * std::sqrt(1e-3 / kDraws));
}

TEST(Random, Uniform_InterleavedStreamsAreUncorrelated) {
  Random random(8);
  constexpr int kDraws = 100000;
  double product = 0;
  double last = random.Uniform() - 0.5;
  for (int i = 0; i < kDraws; ++i) {
    const double next = random.Uniform() - 0.5;
    product += last * next;
    last = next;
  }
  EXPECT_NEAR(product / kDraws, 0, 5.0 / 12 / std::sqrt(kDraws));
}

TEST(Random, UniformInRange_ScalesToTheRange) {
  Random a(3), b(3);
  for (int i = 0; i < 100; ++i) {
    const double x = a.Uniform(-2, 5);
    EXPECT_GE(x, -2);
    EXPECT_LT(x, 5);
    EXPECT_DOUBLE_EQ(x, -2 + 7 * b.Uniform());
  }
}

TEST(Random, Normal_HasMomentsOfStandardNormal) {
  Random random(11);
  constexpr int kDraws = 200000;
  double sum = 0, sum2 = 0, sum3 = 0, sum4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Normal();
    sum += x;
    sum2 += x * x;
    sum3 += x * x * x;
    sum4 += x * x * x * x;
  }
  // Five standard errors: the variances of x, x², x³, x⁴ are 1, 2, 15, 96.
  EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(1.0 / kDraws));
  EXPECT_NEAR(sum2 / kDraws, 1, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(sum3 / kDraws, 0, 5 * std::sqrt(15.0 / kDraws));
  EXPECT_NEAR(sum4 / kDraws, 3, 5 * std::sqrt(96.0 / kDraws));
}

TEST(Random, Below_CoversItsRangeEvenly) {
  Random random(5);
  constexpr int kBound = 6, kDraws = 60000;
  constexpr double kExpected = 10000;
  std::array<int, kBound> count{};
  for (int i = 0; i < kDraws; ++i) ++count.at(random.Below(kBound));
  double chi2 = 0;
  for (const int c : count) chi2 += (c - kExpected) * (c - kExpected) / kExpected;
  EXPECT_LT(chi2, 20.5);  // the 0.999 quantile at 5 degrees of freedom
}

TEST(Random, Below_One_IsZero) {
  Random random(5);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.Below(1), 0U);
}

TEST(Random, Below_LargestBound_StaysBelowIt) {
  Random random(5);
  constexpr std::uint64_t kBound = (std::uint64_t{1} << 63) + 1;  // half of all draws are turned down
  for (int i = 0; i < 100; ++i) EXPECT_LT(random.Below(kBound), kBound);
}

TEST(Random, ForKey_DependsOnSeedAndKeyOnly) {
  EXPECT_EQ(Random::ForKey(1, "leaf/3").NextBits(), Random::ForKey(1, "leaf/3").NextBits());
  std::set<std::uint64_t> first_draws;
  for (const std::uint64_t seed : {0, 1, 2}) {
    for (const char* key : {"", "leaf/3", "leaf/4", "3/leaf"}) {
      first_draws.insert(Random::ForKey(seed, key).NextBits());
    }
  }
  EXPECT_EQ(first_draws.size(), 12U);
}

}  // namespace
}  // namespace frond
