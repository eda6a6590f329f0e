// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// How far ½ Σ r² can be from its exact value by rounding alone, where each residual is a difference of terms
// whose 2-norm over all residuals is `scale_norm`, and the residuals' own is `residual_norm`. A term comes
// with a relative error of k u, u = 2⁻⁵³ and k = 64 (a model is a few dozen operations; exp(t) alone
// multiplies the error of its argument by t), hence the bound by Cauchy and Schwarz
//
//   ½ (‖r‖ + k u ‖s‖)² − ½ ‖r‖² = k u ‖s‖ ‖r‖ + ½ (k u ‖s‖)².
inline double RoundingFloor(double residual_norm, double scale_norm) {
  constexpr double kRounding = 64 * 0x1.0p-53;
  const double error = kRounding * scale_norm;
  return error * residual_norm + error * error / 2;
}

}  // namespace frond
