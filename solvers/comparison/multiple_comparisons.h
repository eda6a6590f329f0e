// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace frond {

// Holm's step-down adjustment (Holm 1979; Wright 1992): of m p-values the i-th least becomes the largest of
// (m − j + 1) p_(j) over j ≤ i, at most 1. Those at most α are then significant with a family-wise error of
// at most α, whatever their dependence. In the order of p_values. Throws std::invalid_argument for one
// outside [0, 1].
std::vector<double> HolmAdjusted(std::span<const double> p_values);

}  // namespace frond
