// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace frond {

struct StepPoint {
  double x, share;
};

// A rising step function: 0 before its first point, then each point's share from its x (included) to the next
// x. Points are strictly increasing in x and in share.
using StepCurve = std::vector<StepPoint>;

// The empirical distribution function: at x the share of all values that are ≤ x. Infinite values, the
// failures, make no step but count in the denominator, so that the curve ends at the share of successes (and
// is empty without any). Throws std::invalid_argument for no values, a NaN or −∞.
StepCurve EmpiricalDistribution(std::span<const double> values);

// The curve's share at x, which may be infinite: there it is the last share. Throws std::invalid_argument for
// NaN.
double ShareAt(const StepCurve& curve, double x);

}  // namespace frond
