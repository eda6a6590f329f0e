// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/step_curve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace frond {

StepCurve EmpiricalDistribution(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("EmpiricalDistribution: no values");
  std::vector<double> finite;
  for (const double value : values) {
    if (!(value > -std::numeric_limits<double>::infinity())) {
      throw std::invalid_argument("EmpiricalDistribution: a value is NaN or -infinity");
    }
    if (std::isfinite(value)) finite.push_back(value);
  }
  std::ranges::sort(finite);
  StepCurve curve;
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i + 1 < finite.size() && finite[i + 1] == finite[i]) continue;
    curve.push_back({finite[i], static_cast<double>(i + 1) / static_cast<double>(values.size())});
  }
  return curve;
}

double ShareAt(const StepCurve& curve, double x) {
  if (std::isnan(x)) throw std::invalid_argument("ShareAt: x is NaN");
  const auto after = std::ranges::upper_bound(curve, x, {}, &StepPoint::x);
  return after == curve.begin() ? 0 : std::prev(after)->share;
}

}  // namespace frond
