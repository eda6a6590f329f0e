// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/normal_distribution.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace frond {
namespace {

// −Φ⁻¹(p) for 0 < p ≤ 1/2, to 4.5e-4: Abramowitz and Stegun (1964) 26.2.23.
double RoughUpperQuantile(double p) {
  const double t = std::sqrt(-2 * std::log(p));
  return t -
         (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
}

}  // namespace

double NormalCdf(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

double NormalQuantile(double p) {
  if (!(p >= 0 && p <= 1)) throw std::invalid_argument("NormalQuantile: p is not in [0, 1]");
  if (p > 0.5) return -NormalQuantile(1 - p);
  if (p == 0) return -std::numeric_limits<double>::infinity();
  // Halley's step for Φ(x) = p with Φ'' = −xΦ'. It triples the digits: three steps are one more than needed.
  double x = -RoughUpperQuantile(p);
  for (int i = 0; i < 3; ++i) {
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
    const double newton = (NormalCdf(x) - p) / density;
    x -= newton / (1 + x * newton / 2);
  }
  return x;
}

}  // namespace frond
