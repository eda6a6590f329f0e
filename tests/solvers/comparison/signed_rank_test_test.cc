// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/signed_rank_test.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/random.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The test of the differences themselves.
SignedRankTest TestDifferences(const std::vector<double>& differences) {
  return WilcoxonSignedRank(differences, std::vector<double>(differences.size(), 0.0));
}

TEST(WilcoxonSignedRank, OfTheDepressionData_MatchesR) {
  // R's example(wilcox.test), Hollander and Wolfe (1973), p. 29: V = 40, two-sided p = 0.03906 = 2 · 10/2⁹.
  const std::array x{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::array y{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const SignedRankTest test = WilcoxonSignedRank(x, y);
  EXPECT_EQ(test.rank_sum_plus, 40);
  EXPECT_EQ(test.rank_sum_minus, 5);
  EXPECT_EQ(test.pairs, 9);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(test.p_value, 20.0 / 512);
}

TEST(WilcoxonSignedRank, OfFiveAndSixPairs_MatchesEnumeration) {
  EXPECT_DOUBLE_EQ(TestDifferences({1, 2, 3, 4, 5}).p_value, 2.0 / 32);  // only {} of 32 sets of ranks
  // W⁻ = 3: {}, {1}, {2}, {3} and {1, 2} of 64 sets sum up to at most 3.
  EXPECT_DOUBLE_EQ(TestDifferences({1, 2, -3, 4, 5, 6}).p_value, 2 * 5.0 / 64);
  // With the mid-ranks 2, 2 and 2 the sum is 0, 2, 4 or 6 in 1, 3, 3 and 1 of 8 ways.
  EXPECT_DOUBLE_EQ(TestDifferences({1, 1, 1}).p_value, 2.0 / 8);
  EXPECT_DOUBLE_EQ(TestDifferences({1, -1, 1}).p_value, 1);
}

TEST(WilcoxonSignedRank, OfDemsarsClassifiers_DropsTheZerosHeSplits) {
  // Demšar (2006), table 2: 1000 times the AUC of C4.5 and of C4.5+m, integers so that his ties tie.
  const std::array<double, 14> c45{763, 599, 954, 628, 882, 936, 661, 583, 775, 1000, 940, 619, 972, 957};
  const std::array<double, 14> c45_m{768, 591, 971, 661, 888, 931, 668, 583, 838, 1000, 962, 666, 981, 978};
  const SignedRankTest test = WilcoxonSignedRank(c45_m, c45);
  // He shares the ranks of both zeros between the sums: 93 and 12. Without the zeros |d| is 5 5 6 7 8 9 17 21
  // 22 33 47 63, of which one 5 (rank 1.5) and the 8 (rank 5) are negative: 6.5, and 78 − 6.5.
  EXPECT_EQ(test.rank_sum_plus, 71.5);
  EXPECT_EQ(test.rank_sum_minus, 6.5);
  EXPECT_EQ(test.pairs, 12);
  // Sets of the ranks 1.5 1.5 3 4 5 6 7 … with a sum of at most 6.5: {}, six single ranks, seven pairs
  // (both 1.5; either 1.5 with 3, 4 or 5) and {1.5, 1.5, 3}: 15 of 2¹².
  EXPECT_DOUBLE_EQ(test.p_value, 2 * 15.0 / 4096);
}

// i ↦ a_i, b_i of scipy_reference.py.
double FirstSample(int i) { return (37 * i + 5) % 101; }
double SecondSample(int i) { return (53 * i + 11) % 97; }

TEST(WilcoxonSignedRank, Exact_MatchesSciPy) {
  // scipy_reference.py, SciPy 1.10.1: the lesser rank sum and p of scipy.stats.wilcoxon(mode="exact").
  struct Reference {
    int pairs;
    double rank_sum, p;
  };
  for (const Reference& r : {Reference{12, 32, 0.6220703125}, Reference{40, 378, 0.6752568088832049}}) {
    std::vector<double> differences;
    for (int i = 0; i < r.pairs; ++i) {
      const double d = FirstSample(i) - SecondSample(i);
      differences.push_back(d + (d < 0 ? -1 : 1) * (i + 1) / 64.0);
    }
    const SignedRankTest test = TestDifferences(differences);
    EXPECT_TRUE(test.exact);
    EXPECT_EQ(std::fmin(test.rank_sum_plus, test.rank_sum_minus), r.rank_sum);
    EXPECT_NEAR(test.p_value, r.p, 1e-13);
  }
}

TEST(WilcoxonSignedRank, ApproximateWithTies_MatchesSciPy) {
  // scipy_reference.py, SciPy 1.10.1: wilcoxon(zero_method="wilcox", correction=True, mode="approx").
  struct Reference {
    double shift;
    int pairs;
    double rank_sum, p;
  };
  for (const Reference& r :
       {Reference{0, 79, 1486.5, 0.6494625143351207}, Reference{10, 80, 1265.0, 0.08906560451236198}}) {
    std::vector<double> a, b;
    for (int i = 0; i < 80; ++i) {
      a.push_back(FirstSample(i));
      b.push_back(SecondSample(i) + r.shift);
    }
    const SignedRankTest test = WilcoxonSignedRank(a, b);
    EXPECT_FALSE(test.exact);
    EXPECT_EQ(test.pairs, r.pairs);
    EXPECT_EQ(std::fmin(test.rank_sum_plus, test.rank_sum_minus), r.rank_sum);
    EXPECT_NEAR(test.p_value, r.p, 1e-13);
  }
}

TEST(WilcoxonSignedRank, ExactAndApproximate_AgreeAtTheirBorder) {
  std::vector<double> differences;
  for (int i = 1; i <= 60; ++i) differences.push_back(i % 3 == 0 ? -i : i);
  const double exact = TestDifferences(differences).p_value;
  differences.push_back(0.5);  // rank 1 of 61: it hardly matters
  const SignedRankTest approximate = TestDifferences(differences);
  EXPECT_FALSE(approximate.exact);
  EXPECT_NEAR(approximate.p_value, exact, 0.05 * exact);
}

TEST(WilcoxonSignedRank, SwappedSamples_SwapTheRankSumsAndKeepThePValue) {
  Random random(12);
  for (const int count : {3, 10, 50, 90}) {
    std::vector<double> a, b;
    for (int i = 0; i < count; ++i) {
      a.push_back(std::floor(10 * random.Uniform()));
      b.push_back(std::floor(10 * random.Uniform()));
    }
    const SignedRankTest forth = WilcoxonSignedRank(a, b), back = WilcoxonSignedRank(b, a);
    EXPECT_EQ(forth.p_value, back.p_value);
    EXPECT_EQ(forth.rank_sum_plus, back.rank_sum_minus);
    EXPECT_EQ(forth.rank_sum_minus, back.rank_sum_plus);
    EXPECT_EQ(forth.rank_sum_plus + forth.rank_sum_minus, forth.pairs * (forth.pairs + 1) / 2.0);
    EXPECT_GT(forth.p_value, 0);
    EXPECT_LE(forth.p_value, 1);
  }
}

TEST(WilcoxonSignedRank, OfFailures_TiesThemAndRanksThemLargest) {
  const std::array a{kInfinity, kInfinity, 1.0, kInfinity, 7.0};
  const std::array b{kInfinity, 1e300, 3.0, 2.0, 6.0};
  const SignedRankTest test = WilcoxonSignedRank(a, b);
  EXPECT_EQ(test.pairs, 4);          // both failed: no difference
  EXPECT_EQ(test.rank_sum_plus, 8);  // the failures share the ranks 3 and 4, and 7 − 6 is rank 1
  EXPECT_EQ(test.rank_sum_minus, 2);
}

TEST(WilcoxonSignedRank, OfEqualSamples_FindsNothing) {
  const std::array a{1.0, kInfinity, 3.0};
  const SignedRankTest test = WilcoxonSignedRank(a, a);
  EXPECT_EQ(test.p_value, 1);
  EXPECT_EQ(test.pairs, 0);
}

TEST(WilcoxonSignedRank, UnderTheNull_RejectsNoMoreOftenThanItSays) {
  Random random(13);
  int rejected = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> differences(15);
    for (double& difference : differences) difference = random.Normal();
    rejected += TestDifferences(differences).p_value <= 0.05 ? 1 : 0;
  }
  // The attainable level below 0.05 with 15 pairs is 0.0479; four standard errors are 0.019.
  EXPECT_NEAR(rejected / 2000.0, 0.0479, 0.019);
}

TEST(WilcoxonSignedRank, BrokenInput_Throws) {
  EXPECT_THROW(WilcoxonSignedRank({}, {}), std::invalid_argument);
  EXPECT_THROW(WilcoxonSignedRank(std::array{1.0}, std::array{1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(WilcoxonSignedRank(std::array{1.0}, std::array{std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace frond
