// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/interpolation_noise.h"

#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "models/smoothing.h"

namespace frond {
namespace {

// Variance of the interpolated noise at fraction t, E[n n″] by a second difference, of noise images.
struct Measured {
  double variance = 0, with_curvature = 0;
};

Measured Measure(double smoothing, double t) {
  Random random(1);
  Image noise(300, 300);
  for (float& value : noise.values) value = static_cast<float>(random.Normal());
  const CubicImage cubic(Smoothed(noise, Mask(), smoothing));
  Measured measured;
  int count = 0;
  constexpr double kStep = 1e-2;
  for (int y = 10; y < 290; ++y) {
    for (int x = 10; x < 290; ++x, ++count) {
      const double at = x + t, n = cubic.AtRow(at, y).value;
      measured.variance += n * n;
      measured.with_curvature +=
          n * (cubic.AtRow(at + kStep, y).dx - cubic.AtRow(at - kStep, y).dx) / (2 * kStep);
    }
  }
  return {measured.variance / count, measured.with_curvature / count};
}

TEST(InterpolationNoise, Moments_AreThoseOfNoiseImages) {
  for (const double smoothing : {0.0, 0.7}) {
    const InterpolationNoise noise(smoothing);
    for (const double t : {0.125, 0.5, 0.75}) {
      const Measured measured = Measure(smoothing, t);
      EXPECT_NEAR(noise.At(t).variance / measured.variance, 1, 0.03) << smoothing << " " << t;
      EXPECT_NEAR(noise.At(t).with_curvature / measured.with_curvature, 1, 0.04) << smoothing << " " << t;
    }
  }
}

TEST(InterpolationNoise, AtAPixel_IsTheNoiseItself) {
  EXPECT_NEAR(InterpolationNoise(0).At(0).variance, 1, 1e-7);
  EXPECT_NEAR(InterpolationNoise(0).At(1).variance, 1, 1e-7);
  const InterpolationNoise smooth(1);
  EXPECT_NEAR(smooth.At(0).variance, smooth.pixel_variance(), 1e-7);
}

TEST(InterpolationNoise, EnergyOfOneSample_IsTheVarianceThere) {
  const std::array<double, 1> influence = {1}, fraction = {0.5};
  const std::array<int, 1> cell = {7};
  EXPECT_NEAR(InterpolationNoise::InterpolatedEnergy(influence.data(), cell.data(), fraction.data(), 1),
              InterpolationNoise(0).At(0.5).variance, 1e-6);
  EXPECT_NEAR(InterpolationNoise(0.8).SmoothedEnergy(influence.data(), 1, 1),
              InterpolationNoise(0.8).pixel_variance(), 1e-12);
}

TEST(InterpolationNoise, EnergyAtWholeShifts_IsTheSumOfSquares) {
  const std::array<double, 5> influence = {1, -2, 3, 0.5, 1}, fraction = {};
  const std::array<int, 5> cell = {3, 4, 5, 6, 7};
  EXPECT_NEAR(InterpolationNoise::InterpolatedEnergy(influence.data(), cell.data(), fraction.data(), 5),
              15.25, 1e-4);
}

}  // namespace
}  // namespace frond
