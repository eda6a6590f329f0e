// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/critical_difference.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "solvers/comparison/studentized_range.h"

namespace frond {

double NemenyiCriticalDifference(std::size_t solvers, std::size_t problems, double significance) {
  if (solvers < 2 || problems < 1) {
    throw std::invalid_argument("NemenyiCriticalDifference: fewer than 2 solvers or no problems");
  }
  const double q = StudentizedRangeQuantile(1 - significance, static_cast<int>(solvers));
  const double k = static_cast<double>(solvers), n = static_cast<double>(problems);
  return q / std::sqrt(2.0) * std::sqrt(k * (k + 1) / (6 * n));
}

std::vector<std::vector<std::size_t>> IndistinguishableGroups(std::span<const double> average_ranks,
                                                              double critical_difference) {
  if (!(critical_difference > 0) ||
      std::ranges::any_of(average_ranks, [](double rank) { return !std::isfinite(rank); })) {
    throw std::invalid_argument(
        "IndistinguishableGroups: a rank that is not finite, or no critical difference");
  }
  std::vector<std::size_t> order(average_ranks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return average_ranks[i]; });
  // The longest stretch of the axis from each solver on, unless an earlier one holds it.
  std::vector<std::vector<std::size_t>> groups;
  std::size_t covered = 0;
  for (std::size_t first = 0, end = 0; first < order.size(); ++first) {
    while (end < order.size() &&
           average_ranks[order[end]] - average_ranks[order[first]] < critical_difference) {
      ++end;
    }
    if (end - first > 1 && end > covered) {
      groups.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(first),
                          order.begin() + static_cast<std::ptrdiff_t>(end));
      covered = end;
    }
  }
  return groups;
}

}  // namespace frond
