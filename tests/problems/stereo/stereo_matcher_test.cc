// SPDX-License-Identifier: BSD-3-Clause
// The whole way from two images to disparities, on pairs whose disparity is known exactly.
#include "problems/stereo/stereo_matcher.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/errors.h"
#include "problems/stereo/mask_edge.h"
#include "problems/stereo/seed_propagation.h"
#include "problems/stereo/textured_pair.h"

namespace frond {
namespace {

double RmseOf(const TexturedPair& pair, const StereoMatches& matches) {
  double squares = 0, count = 0;
  for (const MatchedWindow& window : matches.windows) {
    if (window.status != WindowStatus::kAccepted) continue;
    squares += std::pow(window.match.warp[0] - pair.Disparity(window.x, window.y), 2);
    ++count;
  }
  return std::sqrt(squares / count);
}

double AcceptedShare(const StereoMatches& matches) {
  return static_cast<double>(matches.counts[0]) / static_cast<double>(matches.windows.size());
}

std::string RefusalOf(const Image& left, const Image& right, const Mask& left_mask = {}) {
  try {
    (void)MatchStereo(left, right, left_mask, {}, {}, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool Holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(StereoMatcher, FromBothStarts_FindsTheDisparities) {
  const TexturedPair pair = MakeTexturedPair({});
  for (const MatchStart start : {MatchStart::kSgbm, MatchStart::kPyramid}) {
    StereoMatchOptions options;
    options.start = start;
    const StereoMatches matches = MatchStereo(pair.left, pair.right, {}, {}, options, 1);
    EXPECT_GT(AcceptedShare(matches), 0.75);
    EXPECT_LT(RmseOf(pair, matches), 0.06);
  }
}

TEST(StereoMatcher, OfNegativeDisparitiesInAGivenRange_FindsThem) {
  const TexturedPair pair = MakeTexturedPair({.disparity = -12});
  StereoMatchOptions options;
  options.disparity = {-25, 5};
  const StereoMatches matches = MatchStereo(pair.left, pair.right, {}, {}, options, 1);
  EXPECT_GT(AcceptedShare(matches), 0.75);
  EXPECT_LT(RmseOf(pair, matches), 0.06);
}

TEST(StereoMatcher, AnyThreads_SameBits) {
  const TexturedPair pair = MakeTexturedPair({.contrast = 6});
  const StereoMatches one = MatchStereo(pair.left, pair.right, {}, {}, {}, 1);
  const StereoMatches three = MatchStereo(pair.left, pair.right, {}, {}, {}, 3);
  ASSERT_EQ(one.windows.size(), three.windows.size());
  for (std::size_t k = 0; k < one.windows.size(); ++k) {
    EXPECT_EQ(one.windows[k].status, three.windows[k].status);
    EXPECT_EQ(one.windows[k].match.warp, three.windows[k].match.warp);
  }
  for (std::size_t i = 0; i < one.disparity.values.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(one.disparity.values[i]),
              std::bit_cast<std::uint32_t>(three.disparity.values[i]));
  }
}

TEST(StereoMatcher, WindowsOfTheImagesBorder_DoNotDependOnWhatLiesBeyond) {
  // Twice in one process: the memory beyond an image's rows differs.
  const TexturedPair pair = MakeTexturedPair({.height = 40});
  const StereoMatches first = MatchStereo(pair.left, pair.right, {}, {}, {}, 1);
  const std::vector<float> elsewhere(100000, std::numeric_limits<float>::quiet_NaN());
  const StereoMatches second = MatchStereo(pair.left, pair.right, {}, {}, {}, 1);
  std::size_t on_border = 0;
  for (std::size_t k = 0; k < first.windows.size(); ++k) {
    EXPECT_EQ(first.windows[k].match.warp, second.windows[k].match.warp);
    if (first.windows[k].y == 0 && first.windows[k].status == WindowStatus::kAccepted) ++on_border;
  }
  EXPECT_GT(on_border, 10U);
}

TEST(SeedPropagation, FromOneGoodWindow_ReachesAllOfItsSurface) {
  constexpr int kSide = 9, kStep = 4;
  WindowGrid grid(kSide, kSide, -1);
  std::vector<MatchedWindow> windows;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      if (row == 6 && column > 0) continue;  // a gap of the grid: the way round it is by its first column
      grid(column, row) = static_cast<int>(windows.size());
      windows.push_back({.x = kStep * column, .y = kStep * row, .status = WindowStatus::kNoStart});
    }
  }
  const auto truth = [](const MatchedWindow& window) { return 5 + 0.3 * window.x - 0.1 * window.y; };
  windows[10] = {.x = windows[10].x,
                 .y = windows[10].y,
                 .status = WindowStatus::kAccepted,
                 .match = {.converged = true, .warp = {truth(windows[10]), 0.3, -0.1}, .sigma = 0.01}};
  const auto try_window = [&](std::size_t k, const WarpValues& start) {
    MatchedWindow tried = windows[k];
    tried.match = {.converged = true, .warp = start, .sigma = 0.02};
    const bool near = std::abs(start[0] - truth(windows[k])) < 1e-9;  // the plane leads there exactly
    tried.status = near ? WindowStatus::kAccepted : WindowStatus::kNotConverged;
    return tried;
  };
  EXPECT_EQ(PropagateSeeds(grid, WarpKind::kLinear, try_window, 2, windows), windows.size() - 1);
  for (const MatchedWindow& window : windows) EXPECT_EQ(window.status, WindowStatus::kAccepted);
}

TEST(StereoMatcher, PixelsOutsideTheMasks_HaveNoSay) {
  TexturedPair pair = MakeTexturedPair({});
  Mask left_mask(pair.left.width, pair.left.height, 1);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 90; ++x) {
      left_mask(x, y) = 0;
      pair.left(x, y) = 250;
    }
  }
  const StereoMatches matches = MatchStereo(pair.left, pair.right, left_mask, {}, {}, 1);
  for (const MatchedWindow& window : matches.windows) EXPECT_GE(window.x, 90);
  for (int y = 0; y < 120; ++y) EXPECT_TRUE(std::isnan(matches.disparity(80, y)));
  EXPECT_GT(AcceptedShare(matches), 0.75);
  EXPECT_LT(RmseOf(pair, matches), 0.08);
}

TEST(StereoMatcher, MatchPoints_AgreesWithTheGrid) {
  const TexturedPair pair = MakeTexturedPair({});
  StereoMatchOptions options;
  options.curvature = false;
  const StereoMatches grid = MatchStereo(pair.left, pair.right, {}, {}, options, 1);
  std::vector<std::array<int, 2>> places;
  for (const MatchedWindow& window : grid.windows) {
    if (window.status == WindowStatus::kAccepted) places.push_back({window.x, window.y});
  }
  const std::vector<MatchedWindow> points = MatchPoints(pair.left, pair.right, {}, {}, places, options, 1);
  ASSERT_EQ(points.size(), places.size());
  for (std::size_t k = 0, g = 0; k < points.size(); ++k, ++g) {
    while (grid.windows[g].status != WindowStatus::kAccepted) ++g;
    EXPECT_EQ(points[k].status, WindowStatus::kAccepted);
    EXPECT_NEAR(points[k].match.warp[0], grid.windows[g].match.warp[0], 1e-4);
  }
}

TEST(StereoMatcher, BadPairs_AreRefusedByName) {
  const TexturedPair pair = MakeTexturedPair({});
  EXPECT_TRUE(Holds(RefusalOf(pair.right, pair.left), "swapped"));
  EXPECT_TRUE(Holds(RefusalOf(pair.left, Image(200, 120, 0)), "the right image is black"));
  EXPECT_TRUE(Holds(RefusalOf(Image(200, 120, 255), pair.right), "the left image is saturated"));
  EXPECT_FALSE(RefusalOf(pair.left, MakeTexturedPair({.width = 190}).right).empty());
  EXPECT_FALSE(RefusalOf(pair.left, pair.right, Mask(200, 120, 0)).empty());
}

TEST(StereoMatcher, OfImagesThatHaveNothingInCommon_AcceptsNextToNothing) {
  const TexturedPair pair = MakeTexturedPair({}), other = MakeTexturedPair({.seed = 7});
  StereoMatchOptions options;
  options.disparity = {0, 40};
  EXPECT_LT(AcceptedShare(MatchStereo(pair.left, other.right, {}, {}, options, 1)), 0.01);
}

TEST(MaskEdge, WithoutEdge_TakesOneRingAStep) {
  Mask mask(9, 9, 0);
  for (int y = 0; y < 7; ++y) {
    for (int x = 1; x < 8; ++x) mask(x, y) = 1;
  }
  const Mask inner = WithoutEdge(mask, 2);
  for (int y = 0; y < 9; ++y) {
    // The image's border is none of the object's.
    for (int x = 0; x < 9; ++x) EXPECT_EQ(inner(x, y), x >= 3 && x < 6 && y < 5 ? 1 : 0) << x << " " << y;
  }
  EXPECT_EQ(WithoutEdge(mask, 0).values, mask.values);
  EXPECT_TRUE(WithoutEdge({}, 3).empty());
}

}  // namespace
}  // namespace frond
