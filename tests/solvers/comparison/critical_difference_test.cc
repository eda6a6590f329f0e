// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/critical_difference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solvers/comparison/normal_distribution.h"
#include "solvers/comparison/studentized_range.h"

namespace frond {
namespace {

using Groups = std::vector<std::vector<std::size_t>>;

TEST(StudentizedRange, Quantiles_MatchDemsarsTable) {
  // Demšar (2006), table 5(a): q/√2. His third digit is off by up to one (2.3437 and 2.9483 are 2.343
  // and 2.949).
  const std::array at_05{1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164};
  const std::array at_10{1.645, 2.052, 2.291, 2.459, 2.589, 2.693, 2.780, 2.855, 2.920};
  for (std::size_t i = 0; i < at_05.size(); ++i) {
    const int k = static_cast<int>(i) + 2;
    EXPECT_NEAR(StudentizedRangeQuantile(0.95, k) / std::sqrt(2), at_05[i], 1e-3) << k;
    EXPECT_NEAR(StudentizedRangeQuantile(0.90, k) / std::sqrt(2), at_10[i], 1e-3) << k;
  }
}

TEST(StudentizedRange, Distribution_MatchesSciPy) {
  struct Reference {
    double q;
    int k;
    double probability;
  };
  // scipy_reference.py, SciPy 1.10.1: scipy.stats.studentized_range.cdf(q, k, inf).
  for (const Reference& r : {Reference{1.0, 2, 0.5204998778130465}, Reference{3.3, 3, 0.9486890935818101},
                             Reference{3.3, 10, 0.6329234898850384}, Reference{5.0, 20, 0.9486353364208663},
                             Reference{0.5, 3, 0.06657805486471302}}) {
    EXPECT_NEAR(StudentizedRangeCdf(r.q, r.k), r.probability, 1e-12) << r.q << " " << r.k;
  }
}

TEST(StudentizedRange, OfTwo_IsTheAbsoluteDifferenceOfNormals) {
  // P(|X − Y| ≤ q) = 2Φ(q/√2) − 1.
  for (int i = 0; i < 32; ++i) {
    const double q = 0.37 * i;
    EXPECT_NEAR(StudentizedRangeCdf(q, 2), 2 * NormalCdf(q / std::sqrt(2)) - 1, 1e-14);
  }
}

TEST(StudentizedRange, Quantile_InvertsTheDistribution) {
  for (const int k : {2, 7, 20, 200}) {
    for (const double p : {0.001, 0.5, 0.9, 0.999999}) {
      EXPECT_NEAR(StudentizedRangeCdf(StudentizedRangeQuantile(p, k), k), p, 1e-12);
    }
  }
}

TEST(NemenyiCriticalDifference, OfDemsarsExample_MatchesHim) {
  EXPECT_NEAR(NemenyiCriticalDifference(4, 14), 1.25, 0.005);
  EXPECT_NEAR(NemenyiCriticalDifference(4, 14, 0.10), 1.12, 0.005);
}

TEST(NemenyiCriticalDifference, GrowsWithSolversAndShrinksWithProblems) {
  for (std::size_t k = 2; k < 20; ++k) {
    EXPECT_LT(NemenyiCriticalDifference(k, 30), NemenyiCriticalDifference(k + 1, 30));
    EXPECT_NEAR(NemenyiCriticalDifference(k, 120), NemenyiCriticalDifference(k, 30) / 2, 1e-12);
  }
}

TEST(NemenyiCriticalDifference, BrokenInput_Throws) {
  EXPECT_THROW(NemenyiCriticalDifference(1, 10), std::invalid_argument);
  EXPECT_THROW(NemenyiCriticalDifference(3, 0), std::invalid_argument);
  EXPECT_THROW(NemenyiCriticalDifference(3, 10, 0), std::invalid_argument);
  EXPECT_THROW(StudentizedRangeCdf(-1, 3), std::invalid_argument);
  EXPECT_THROW(StudentizedRangeCdf(1, 1), std::invalid_argument);
}

TEST(IndistinguishableGroups, OfDemsarsExample_SayWhatHeSays) {
  // At 0.05 nothing differs; at 0.10 C4.5 (index 0) is worse than C4.5+m (1) and C4.5+m+cf (3).
  const std::array ranks{3.143, 2.000, 2.893, 1.964};
  EXPECT_EQ(IndistinguishableGroups(ranks, 1.25), (Groups{{3, 1, 2, 0}}));
  EXPECT_EQ(IndistinguishableGroups(ranks, 1.12), (Groups{{3, 1, 2}, {2, 0}}));
}

TEST(IndistinguishableGroups, AreMaximalAndOfTwoOrMore) {
  const std::array ranks{1.0, 1.4, 1.9, 4.0, 6.0, 6.5};
  EXPECT_EQ(IndistinguishableGroups(ranks, 0.6), (Groups{{0, 1}, {1, 2}, {4, 5}}));
  EXPECT_EQ(IndistinguishableGroups(ranks, 1.0), (Groups{{0, 1, 2}, {4, 5}}));
  EXPECT_EQ(IndistinguishableGroups(ranks, 9.0), (Groups{{0, 1, 2, 3, 4, 5}}));
  EXPECT_TRUE(IndistinguishableGroups(ranks, 0.3).empty());
  EXPECT_TRUE(IndistinguishableGroups({}, 1).empty());
}

TEST(IndistinguishableGroups, ADifferenceOfExactlyTheCriticalOne_Differs) {
  EXPECT_TRUE(IndistinguishableGroups(std::array{1.0, 2.0}, 1.0).empty());
}

TEST(IndistinguishableGroups, BrokenInput_Throws) {
  EXPECT_THROW(IndistinguishableGroups(std::array{1.0, 2.0}, 0), std::invalid_argument);
  EXPECT_THROW(IndistinguishableGroups(std::array{1.0, std::nan("")}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace frond
