// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/studentized_range.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solvers/comparison/normal_distribution.h"

namespace frond {

double StudentizedRangeCdf(double q, int k) {
  if (k < 2 || !(q >= 0)) throw std::invalid_argument("StudentizedRangeCdf: k < 2 or q < 0");
  // z is the largest of the k. The trapezoidal rule converges faster than any power of its step where, as
  // here, all derivatives vanish at both ends (φ(±9) = 1e-18).
  constexpr int kSteps = 180;
  constexpr double kEnd = 9, kStep = 2 * kEnd / kSteps;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = -kEnd + i * kStep;
    sum += std::exp(-z * z / 2) * std::pow(NormalCdf(z) - NormalCdf(z - q), k - 1);
  }
  return k * sum * kStep / std::sqrt(2 * std::numbers::pi);
}

double StudentizedRangeQuantile(double p, int k) {
  if (!(p > 0 && p < 1)) throw std::invalid_argument("StudentizedRangeQuantile: p is not in (0, 1)");
  double lower = 0, upper = 1;
  while (StudentizedRangeCdf(upper, k) < p && upper < 32) upper *= 2;
  while (upper - lower > 1e-13 * upper) {
    const double middle = (lower + upper) / 2;
    (StudentizedRangeCdf(middle, k) < p ? lower : upper) = middle;
  }
  return (lower + upper) / 2;
}

}  // namespace frond
