// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace frond {

// The sample quantile of type 7 (Hyndman and Fan 1996; the default of R and NumPy): linear between the order
// statistics at (n − 1)p. Values may be infinite, as of failed runs: between an infinite and another value
// stands the infinite one (+∞ between −∞ and +∞), never NaN. Throws std::invalid_argument for no values, a
// NaN, or p outside [0, 1].
double Quantile(std::span<const double> values, double p);

// Quantile(values, 1/2): the mean of the two middle values where their count is even, unlike base/median.h.
double SampleMedian(std::span<const double> values);

struct Quartiles {
  double lower, median, upper;
};

// The quantiles at 1/4, 1/2 and 3/4.
Quartiles SampleQuartiles(std::span<const double> values);

}  // namespace frond
