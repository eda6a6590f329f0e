// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace frond {

struct SignedRankTest {
  double rank_sum_plus;   // the ranks of the pairs with a > b
  double rank_sum_minus;  // the ranks of the pairs with a < b
  double p_value;         // two-sided; 1 without a pair that differs
  int pairs;              // those that differ
  bool exact;             // p_value from the exact null distribution
};

// Wilcoxon's paired signed-rank test, two-sided, of the pairs (a[i], b[i]) (Wilcoxon 1945). Pairs without a
// difference are dropped; |a − b| is ranked, ties share mid-ranks (mid_ranks.h). Values may be infinite, as
// the costs of failed runs: equal infinities do not differ, and a failure against a success is the largest
// difference.
//
// p = min(1, 2 P(W ≤ min(W⁺, W⁻))). Up to 60 pairs P is exact, given the ties: each rank, doubled to be an
// integer, is in W with probability 1/2, summed up one after the other (Streitberg and Röhmel 1986). Beyond
// it is normal with mean n(n + 1)/4 and variance Σ rank²/4 (which holds the correction for ties), corrected
// by 1/2 for continuity.
//
// Throws std::invalid_argument for no pairs, spans of different lengths or a NaN.
SignedRankTest WilcoxonSignedRank(std::span<const double> a, std::span<const double> b);

}  // namespace frond
