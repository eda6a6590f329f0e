// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/success_rate.h"

#include <cmath>
#include <stdexcept>

#include "solvers/comparison/normal_distribution.h"

namespace frond {

Interval WilsonInterval(std::int64_t successes, std::int64_t trials, double confidence) {
  if (trials < 1) throw std::invalid_argument("WilsonInterval: no trials");
  if (successes < 0 || successes > trials) {
    throw std::invalid_argument("WilsonInterval: successes are not in [0, trials]");
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("WilsonInterval: confidence is not in (0, 1)");
  }
  const double z = -NormalQuantile((1 - confidence) / 2);
  const double n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double scale = 1 + z * z / n;
  const double center = (p + z * z / (2 * n)) / scale;
  const double half_width = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / scale;
  // The outer ends are exact where rounding would leave 1e-17.
  return {successes == 0 ? 0 : center - half_width, successes == trials ? 1 : center + half_width};
}

}  // namespace frond
