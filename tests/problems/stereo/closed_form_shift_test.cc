// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/closed_form_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "window_case.h"

namespace frond {
namespace {

// corr(w_d + τ (w_d − w_{d−1}), L) with |w_d| = |L| = 1.
double Correlation(double tau, double rho_d, double rho_m, double r, double lambda) {
  const double numerator = (1 + tau) * rho_d - tau * lambda * rho_m;
  const double squares =
      (1 + tau) * (1 + tau) + tau * tau * lambda * lambda - 2 * tau * (1 + tau) * lambda * r;
  return numerator / std::sqrt(squares);
}

TEST(ClosedFormShift, OfRandomCorrelations_IsTheBruteForceMaximum) {
  Random random(5);
  int found = 0, inside = 0;
  for (int i = 0; i < 2000; ++i) {
    // Correlations of three vectors in space exist together.
    const double angle_d = random.Uniform(0, 1.2), angle_m = random.Uniform(0, 1.2),
                 turn = random.Uniform(0, 3.1);
    const double rho_d = std::cos(angle_d), rho_m = std::cos(angle_m), lambda = random.Uniform(0.7, 1.4);
    const double r = rho_d * rho_m + std::sin(angle_d) * std::sin(angle_m) * std::cos(turn);
    double best = -2, best_tau = 0;
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k) {
      const double tau = -static_cast<double>(k) / kSteps, value = Correlation(tau, rho_d, rho_m, r, lambda);
      if (value > best) best = value, best_tau = tau;
    }
    const ClosedFormShift shift = BestShiftBetween(rho_d, rho_m, r, lambda);
    const bool is_inside = best_tau > -0.999 && best_tau < -0.001;
    inside += is_inside ? 1 : 0;
    if (is_inside) {
      ASSERT_TRUE(shift.found) << i;
    }
    if (!shift.found) continue;
    ++found;
    EXPECT_NEAR(shift.disparity, best_tau, 1e-3) << i;
    EXPECT_NEAR(shift.correlation, best, 1e-6) << i;
  }
  EXPECT_GT(inside, 500);
}

TEST(ClosedFormShift, OfATexturedPair_IsWithinATenthOfAPixel) {
  const WindowCase with({.slope_x = 0, .slope_y = 0.01, .noise = 0.5});
  for (const WindowPlace& place : Places(with, 9)) {
    const double truth = with.Truth(place.x, place.y);
    const int start = static_cast<int>(std::lround(place.start[0]));
    if (std::abs(start - truth) > 1) continue;
    const ClosedFormShift shift =
        MatchClosedForm(with.pair.left, {}, with.pair.right, {}, 15, place.x, place.y, start);
    ASSERT_TRUE(shift.found);
    EXPECT_NEAR(shift.disparity, truth, 0.1);
    EXPECT_GT(shift.correlation, 0.98);
  }
}

TEST(ClosedFormShift, OfAFlatOrMaskedWindow_IsNotFound) {
  const Image flat(60, 40, 100);
  EXPECT_FALSE(MatchClosedForm(flat, {}, flat, {}, 15, 30, 20, 5).found);
  const WindowCase with({});
  const Mask nothing(with.pair.left.width, with.pair.left.height, 0);
  EXPECT_FALSE(MatchClosedForm(with.pair.left, nothing, with.pair.right, {}, 15, 100, 60, 20).found);
}

}  // namespace
}  // namespace frond
