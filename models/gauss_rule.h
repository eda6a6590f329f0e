// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace frond {

struct GaussRule {
  std::vector<double> nodes, weights;  // on [0, 1]
};

inline constexpr int kMaxGaussPoints = 16;

// Gauss–Legendre of 1 to kMaxGaussPoints points: exact for polynomials of degree 2 count − 1.
const GaussRule& GaussRuleOf(int count);

}  // namespace frond
