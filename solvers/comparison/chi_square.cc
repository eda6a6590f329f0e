// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/chi_square.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace frond {

double ChiSquareUpperTail(double x, int degrees_of_freedom) {
  if (degrees_of_freedom < 1 || !(x >= 0)) {
    throw std::invalid_argument("ChiSquareUpperTail: x < 0 or no degrees of freedom");
  }
  if (std::isinf(x)) return 0;
  // Q(a + 1, y) = Q(a, y) + yᵃ e⁻ʸ/Γ(a + 1), from Q(1/2, y) = erfc √y or Q(1, y) = e⁻ʸ.
  const double y = x / 2;
  const bool odd = degrees_of_freedom % 2 == 1;
  double tail = odd ? std::erfc(std::sqrt(y)) : std::exp(-y);
  double term = odd ? 2 * std::sqrt(y / std::numbers::pi) * std::exp(-y) : y * std::exp(-y);
  for (int twice_a = odd ? 1 : 2; twice_a < degrees_of_freedom; twice_a += 2) {
    tail += term;
    term *= y / (twice_a / 2.0 + 1);
  }
  return std::min(tail, 1.0);
}

}  // namespace frond
