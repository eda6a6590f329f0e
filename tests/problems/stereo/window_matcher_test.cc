// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_matcher.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "problems/stereo/auto_diff_matcher.h"
#include "problems/stereo/window_fit.h"
#include "window_case.h"

namespace frond {
namespace {

WindowMatcher Matcher(const WindowCase& with, const WindowModel& model) {
  return {with.pair.left, with.all, with.right, with.all, model};
}

TEST(WindowMatcher, WithoutNoise_FindsDisparitySlopesAndExposure) {
  const WindowCase with({.noise = 0});
  const WindowMatcher matcher = Matcher(with, {});
  for (const WindowPlace& place : Places(with, 8)) {
    const WindowMatch match = matcher.Match(place.x, place.y, place.start);
    ASSERT_TRUE(match.converged);
    EXPECT_EQ(match.pixels, 225);
    EXPECT_NEAR(match.warp[0], with.Truth(place.x, place.y), 2e-3);
    EXPECT_NEAR(match.warp[1], 0.05, 1e-3);
    EXPECT_NEAR(match.warp[2], 0.02, 1e-3);
    EXPECT_NEAR(match.radiometry[0], 0.8, 2e-3);
    EXPECT_NEAR(match.radiometry[1], 15, 0.3);
    EXPECT_GT(match.correlation, 0.9999);
    EXPECT_LT(match.sigma, 2e-3);
  }
}

class EveryWindowModel : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(EveryWindowModel, StructuredAndAutoDiff_AgreeToATenThousandthOfAPixel) {
  const auto [warp, radiometry] = GetParam();
  const WindowModel model{.warp = static_cast<WarpKind>(warp),
                          .radiometry = static_cast<RadiometryKind>(radiometry)};
  const bool flat = model.warp == WarpKind::kShift, same = model.radiometry == RadiometryKind::kNone;
  const WindowCase with({.slope_x = flat ? 0 : 0.05,
                         .slope_y = flat ? 0 : 0.02,
                         .gain = same ? 1 : 0.8,
                         .offset = same ? 0.0 : 15,
                         .noise = 1});
  const WindowMatcher matcher = Matcher(with, model);
  int compared = 0, count = 0;
  for (const WindowPlace& place : Places(with, 10)) {
    const WindowMatch fast = matcher.Match(place.x, place.y, place.start);
    const WindowMatch plain = MatchByAutoDiff(with.images(), model, place.x, place.y, place.start);
    ++count;
    if (!fast.converged || !plain.converged) continue;
    ++compared;
    EXPECT_NEAR(fast.warp[0], plain.warp[0], 1e-4);
    EXPECT_NEAR(fast.sigma, plain.sigma, 1e-3 * plain.sigma + 1e-5);
    EXPECT_NEAR(fast.noise, plain.noise, 1e-6);
    EXPECT_NEAR(fast.warp[0], with.Truth(place.x, place.y), 0.25);
  }
  EXPECT_GE(compared, 0.97 * count);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryWindowModel,
                         testing::Combine(testing::Range(0, 4), testing::Range(0, 3)));

TEST(WindowMatcher, AtAMask_UsesThePixelsInsideAlone) {
  WindowCase with({.noise = 0});
  Mask mask(with.pair.left.width, with.pair.left.height, 1);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < 100; ++x) mask(x, y) = 0;
    for (int x = 0; x < 100; ++x) with.pair.left(x, y) = 0;  // would spoil the window
  }
  const WindowMatcher matcher(with.pair.left, mask, with.right, with.all, {});
  const WindowMatch match = matcher.Match(102, 60, {with.Truth(102, 60) + 0.3});
  ASSERT_TRUE(match.converged);
  EXPECT_EQ(match.pixels, 10 * 15);
  EXPECT_NEAR(match.warp[0], with.Truth(102, 60), 5e-3);
  EXPECT_FALSE(matcher.Match(94, 60, {with.Truth(94, 60)}).converged) << "fewer than a third";
}

TEST(WindowMatcher, AtTheRightMask_SettlesOnThePixelsAtTheResult) {
  const WindowCase with({.noise = 0});
  Mask right_mask(with.right.width(), with.right.height(), 1);
  for (int y = 0; y < right_mask.height; ++y) {
    for (int x = 80; x < right_mask.width; ++x) right_mask(x, y) = 0;
  }
  const WindowMatcher matcher(with.pair.left, with.all, with.right, right_mask, {});
  const double truth = with.Truth(100, 60);
  const WindowMatch one = matcher.Match(100, 60, {truth - 0.5}),
                    other = matcher.Match(100, 60, {truth + 0.5});
  ASSERT_TRUE(one.converged && other.converged);
  EXPECT_EQ(one.pixels, other.pixels);
  EXPECT_LT(one.pixels, 225);
  EXPECT_NEAR(one.warp[0], other.warp[0], 1e-5);
}

TEST(WindowMatcher, OfAFlatWindow_DoesNotConverge) {
  const Image flat(60, 40, 100);
  const CubicImage right(flat);
  const Mask all;
  for (const RadiometryKind kind :
       {RadiometryKind::kNone, RadiometryKind::kGainOffset, RadiometryKind::kPlanarGain}) {
    const WindowMatcher matcher(flat, all, right, all, {.radiometry = kind});
    EXPECT_FALSE(matcher.Match(30, 20, {4}).converged);
  }
}

TEST(WindowMatcher, OfAnUnrectifiedPair_FindsTheVerticalShift) {
  // The rows of the left image half a pixel lower: v = −0.5.
  const WindowCase with({.slope_y = 0, .noise = 0});
  const CubicImage left(with.pair.left);
  Image lower(with.pair.left.width, with.pair.left.height);
  for (int y = 0; y < lower.height; ++y) {
    for (int x = 0; x < lower.width; ++x) lower(x, y) = static_cast<float>(left.ValueAt(x, y + 0.5));
  }
  const WindowMatcher matcher(lower, with.all, with.right, with.all, {.warp = WarpKind::kAffine});
  const WindowMatch match = matcher.Match(100, 60, {with.Truth(100, 60) + 0.3});
  ASSERT_TRUE(match.converged);
  EXPECT_NEAR(match.warp[0], with.Truth(100, 60), 5e-3);
  EXPECT_NEAR(match.warp[3], -0.5, 5e-3);
}

TEST(WindowMatcher, BadWindowsAndImages_AreRefused) {
  const WindowCase with({});
  EXPECT_THROW(Matcher(with, {.size = 14}), ConfigError);
  EXPECT_THROW(Matcher(with, {.size = 65}), ConfigError);
  EXPECT_THROW(Matcher(with, {.smoothing = -1}), ConfigError);
  const Image other(200, 50, 1);
  EXPECT_THROW(WindowMatcher(other, {}, with.right, {}, {}), InputError);
  const Mask small(10, 10, 1);
  EXPECT_THROW(WindowMatcher(with.pair.left, small, with.right, {}, {}), InputError);
  EXPECT_THROW(WarpFrom("cubic"), ConfigError);
  EXPECT_THROW(RadiometryFrom("gain"), ConfigError);
}

}  // namespace
}  // namespace frond
