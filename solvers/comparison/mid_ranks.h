// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace frond {

// The ranks of the values, 1 for the least; equal values (equal infinities too) share the mean of their
// ranks. Only exactly equal values tie: scale decimals that should tie to integers. Throws
// std::invalid_argument for a NaN.
std::vector<double> MidRanks(std::span<const double> values);

}  // namespace frond
