// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/log_relative_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace frond {

double LogRelativeError(double computed, double certified) {
  constexpr double kCertifiedDigits = 11;
  if (!std::isfinite(certified))
    throw std::invalid_argument("LogRelativeError: a certified value is not finite");
  if (!std::isfinite(computed)) return 0;
  const double scale = certified == 0 ? 1 : std::abs(certified);
  return std::clamp(-std::log10(std::abs(certified - computed) / scale), 0.0, kCertifiedDigits);
}

}  // namespace frond
