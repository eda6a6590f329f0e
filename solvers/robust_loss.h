// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace frond {

enum class RobustLossType { kNone, kHuber, kCauchy, kTukey };

// A robust loss ρ as a value, for rows that are weighted before they are compressed: the same functions, to
// the bit, as ceres::HuberLoss(scale), CauchyLoss and TukeyLoss. The cost of a row with squared residual s is
// ½ρ(s). All are concave (ρ″ ≤ 0), so Ceres's own correction of a block is √ρ′ on residual and Jacobian,
// nothing more (α = 0 in Triggs' formula), and ρ(s) ≥ ρ′(s)·s.
struct RobustLoss {
  RobustLossType type = RobustLossType::kNone;
  double scale = 1;  // > 0, in the residual's unit: where outliers begin

  struct Value {
    double rho;         // ρ(s)
    double derivative;  // ρ′(s)
  };

  Value operator()(double squared_residual) const {
    constexpr double kTiny = std::numeric_limits<double>::min();
    const double s = squared_residual;
    const double scale2 = scale * scale;
    switch (type) {
      case RobustLossType::kNone:
        break;
      case RobustLossType::kHuber: {
        if (s <= scale2) break;
        const double r = std::sqrt(s);
        return {2 * scale * r - scale2, std::max(kTiny, scale / r)};
      }
      case RobustLossType::kCauchy: {
        const double sum = 1 + s * (1 / scale2);
        return {scale2 * std::log(sum), std::max(kTiny, 1 / sum)};
      }
      case RobustLossType::kTukey: {
        if (s > scale2) return {scale2 / 3, 0};
        const double value = 1 - s / scale2;
        return {scale2 / 3 * (1 - value * value * value), value * value};
      }
    }
    return {s, 1};
  }
};

// "none", "huber", "cauchy", "tukey": the words for an option of a fit.
const std::vector<std::string>& RobustLossNames();

// Throws ConfigError for an unknown name or a scale that is not a positive number.
RobustLoss MakeRobustLoss(const std::string& name, double scale);

// The same loss for a plain residual block; null for kNone. The caller (or its ceres::Problem) owns it.
std::unique_ptr<ceres::LossFunction> MakeCeresLoss(const RobustLoss& loss);

}  // namespace frond
