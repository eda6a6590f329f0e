// SPDX-License-Identifier: BSD-3-Clause
#include "models/cubic_image.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/random.h"
#include "models/smoothing.h"

namespace frond {
namespace {

Image RandomImage(int width, int height) {
  Random random(7);
  Image image(width, height);
  for (float& value : image.values) value = static_cast<float>(random.Uniform(0, 255));
  return image;
}

TEST(CubicImage, AtPixels_IsTheImage) {
  const Image image = RandomImage(17, 11);
  const CubicImage cubic(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto value = static_cast<double>(image(x, y));
      EXPECT_NEAR(cubic.At(x, y).value, value, 1e-3);
      EXPECT_NEAR(cubic.AtRow(x, y).value, value, 1e-3);
    }
  }
}

TEST(CubicImage, InARow_IsTheSplineOfTheImage) {
  const CubicImage cubic(RandomImage(17, 11));
  for (double x = 0; x <= 16; x += 0.13) {
    const CubicSample row = cubic.AtRow(x, 4), both = cubic.At(x, 4);
    EXPECT_NEAR(row.value, both.value, 1e-3);
    EXPECT_NEAR(row.dx, both.dx, 1e-3);
  }
}

TEST(CubicImage, OfACubicPolynomial_IsThePolynomialAwayFromTheBorder) {
  Image image(60, 60);
  const auto polynomial = [](double x, double y) {
    const double s = (x - 30) / 10, t = (y - 30) / 10;
    return 100 + 5 * s * s * s - 3 * s * t * t + 2 * t - s * s;
  };
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) image(x, y) = static_cast<float>(polynomial(x, y));
  }
  const CubicImage cubic(image);
  EXPECT_NEAR(cubic.At(28.37, 33.71).value, polynomial(28.37, 33.71), 1e-4);
}

TEST(CubicImage, Gradient_IsTheDerivativeOfTheValue) {
  const CubicImage cubic(RandomImage(17, 11));
  const double h = 1e-5;
  for (const auto& [x, y] : {std::pair{3.3, 4.8}, {0.2, 0.1}, {15.7, 9.6}}) {
    const CubicSample sample = cubic.At(x, y);
    EXPECT_NEAR(sample.dx, (cubic.ValueAt(x + h, y) - cubic.ValueAt(x - h, y)) / (2 * h), 1e-4);
    EXPECT_NEAR(sample.dy, (cubic.ValueAt(x, y + h) - cubic.ValueAt(x, y - h)) / (2 * h), 1e-4);
  }
}

TEST(CubicImage, OfJets_FollowsTheChainRule) {
  using Jet = ceres::Jet<double, 2>;
  const CubicImage cubic(RandomImage(17, 11));
  const Jet x = 2.0 * Jet(3.3, 0), y = Jet(4.8, 1);
  const CubicSample sample = cubic.At(6.6, 4.8);
  const Jet value = cubic.ValueAt(x, y);
  EXPECT_DOUBLE_EQ(value.a, sample.value);
  EXPECT_DOUBLE_EQ(value.v[0], 2 * sample.dx);
  EXPECT_DOUBLE_EQ(value.v[1], sample.dy);
  EXPECT_DOUBLE_EQ(cubic.ValueAtRow(x, 4).v[0], 2 * cubic.AtRow(6.6, 4).dx);
}

TEST(CubicImage, Outside_IsTheNearestBorderPoint) {
  const CubicImage cubic(RandomImage(17, 11));
  EXPECT_EQ(cubic.At(-3, 50).value, cubic.At(0, 10).value);
  EXPECT_EQ(cubic.AtRow(99, 3).value, cubic.AtRow(16, 3).value);
  EXPECT_TRUE(std::isfinite(cubic.AtRow(std::numeric_limits<double>::quiet_NaN(), 3).value));
}

TEST(CubicImage, OfALineOfPixels_IsRefused) { EXPECT_THROW(CubicImage(Image(9, 1)), InputError); }

TEST(Smoothing, OfAConstantImage_IsTheImage) {
  const Image image(20, 10, 42);
  for (const float value : Smoothed(image, Mask(), 1.3).values) EXPECT_NEAR(value, 42, 1e-4);
}

TEST(Smoothing, NearAMask_TakesNothingFromOutside) {
  Image image(20, 10, 42);
  Mask mask(20, 10, 1);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 8; ++x) mask(x, y) = 0, image(x, y) = 250;
  }
  const Image smoothed = Smoothed(image, mask, 1.3);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_NEAR(smoothed(x, y), image(x, y), 1e-4);
  }
}

TEST(Smoothing, OfWhiteNoise_LeavesTheVarianceOfItsKernel) {
  Random random(3);
  Image image(200, 200);
  for (float& value : image.values) value = static_cast<float>(random.Normal());
  double expected = 0, measured = 0;
  for (const double k : GaussianKernel(1)) expected += k * k;
  for (const float value : Smoothed(image, Mask(), 1).values) measured += static_cast<double>(value * value);
  EXPECT_NEAR(measured / 40000 / (expected * expected), 1, 0.05);
}

}  // namespace
}  // namespace frond
