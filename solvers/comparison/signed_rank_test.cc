// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/signed_rank_test.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "solvers/comparison/mid_ranks.h"
#include "solvers/comparison/normal_distribution.h"

namespace frond {
namespace {

constexpr std::size_t kMostExactPairs = 60;

std::vector<double> NonZeroDifferences(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || a.size() != b.size()) {
    throw std::invalid_argument("WilcoxonSignedRank: no pairs, or samples of different lengths");
  }
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i]))
      throw std::invalid_argument("WilcoxonSignedRank: a value is NaN");
    if (a[i] != b[i]) differences.push_back(a[i] - b[i]);
  }
  return differences;
}

// P(W ≤ bound), each rank being in W with probability 1/2.
double ExactLowerTail(std::span<const double> ranks, double bound) {
  const auto doubled_bound = static_cast<std::size_t>(std::lround(2 * bound));
  std::vector<double> probability(doubled_bound + 1, 0.0);  // of each doubled sum
  probability[0] = 1;
  for (const double rank : ranks) {
    const auto doubled_rank = static_cast<std::size_t>(std::lround(2 * rank));
    for (std::size_t sum = doubled_bound + 1; sum-- > 0;) {
      const double with_rank = sum >= doubled_rank ? probability[sum - doubled_rank] : 0;
      probability[sum] = (probability[sum] + with_rank) / 2;
    }
  }
  double tail = 0;
  for (const double p : probability) tail += p;
  return tail;
}

double NormalLowerTail(std::span<const double> ranks, double bound) {
  const double n = static_cast<double>(ranks.size());
  double variance = 0;
  for (const double rank : ranks) variance += rank * rank / 4;
  return NormalCdf((bound + 0.5 - n * (n + 1) / 4) / std::sqrt(variance));
}

}  // namespace

SignedRankTest WilcoxonSignedRank(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> differences = NonZeroDifferences(a, b);
  std::vector<double> sizes = differences;
  for (double& size : sizes) size = std::abs(size);
  const std::vector<double> ranks = MidRanks(sizes);

  SignedRankTest test{0, 0, 1, static_cast<int>(ranks.size()), ranks.size() <= kMostExactPairs};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    (differences[i] > 0 ? test.rank_sum_plus : test.rank_sum_minus) += ranks[i];
  }
  const double bound = std::min(test.rank_sum_plus, test.rank_sum_minus);
  const double tail = test.exact ? ExactLowerTail(ranks, bound) : NormalLowerTail(ranks, bound);
  test.p_value = std::min(1.0, 2 * tail);
  return test;
}

}  // namespace frond
