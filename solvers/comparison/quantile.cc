// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

std::vector<double> Sorted(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("Quantile: no values");
  if (std::ranges::any_of(values, [](double value) { return std::isnan(value); })) {
    throw std::invalid_argument("Quantile: a value is NaN");
  }
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

double SortedQuantile(std::span<const double> sorted, double p) {
  if (!(p >= 0 && p <= 1)) throw std::invalid_argument("Quantile: p is not in [0, 1]");
  double place = static_cast<double>(sorted.size() - 1) * p;
  // A place that rounding moved off its order statistic must not reach for an infinite neighbour.
  const double nearest = std::round(place);
  if (std::abs(place - nearest) <= 4 * std::numeric_limits<double>::epsilon() * nearest) place = nearest;
  const auto index = static_cast<std::size_t>(place);
  const double fraction = place - std::floor(place);
  const double lower = sorted[index];
  if (fraction == 0) return lower;
  const double upper = sorted[index + 1];
  if (lower == upper || std::isinf(upper)) return upper;
  if (std::isinf(lower)) return lower;
  return (1 - fraction) * lower + fraction * upper;
}

}  // namespace

double Quantile(std::span<const double> values, double p) { return SortedQuantile(Sorted(values), p); }

double SampleMedian(std::span<const double> values) { return Quantile(values, 0.5); }

Quartiles SampleQuartiles(std::span<const double> values) {
  const std::vector<double> sorted = Sorted(values);
  return {SortedQuantile(sorted, 0.25), SortedQuantile(sorted, 0.5), SortedQuantile(sorted, 0.75)};
}

}  // namespace frond
