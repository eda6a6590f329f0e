// SPDX-License-Identifier: BSD-3-Clause
// The predicted standard deviation against known shifts and noise.
#include <gtest/gtest.h>

#include <cmath>

#include "problems/stereo/window_matcher.h"
#include "window_case.h"

namespace frond {
namespace {

struct Texture {
  double contrast, grain, smoothing, gain;
  WarpKind warp = WarpKind::kLinear;
  int size = 15;
};

class Sigma : public testing::TestWithParam<Texture> {};

TEST_P(Sigma, HoldsTwoThirdsOfTheErrors) {
  const Texture& texture = GetParam();
  int within = 0, count = 0;
  double squares = 0, predicted = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const WindowCase with({.width = 300,
                           .height = 150,
                           .contrast = texture.contrast,
                           .grain = texture.grain,
                           .gain = texture.gain,
                           .seed = seed},
                          texture.smoothing);
    const WindowMatcher matcher(with.pair.left, with.all, with.right, with.all,
                                {.size = texture.size, .warp = texture.warp, .smoothing = texture.smoothing});
    for (const WindowPlace& place : Places(with, 8)) {
      const WindowMatch match = matcher.Match(place.x, place.y, place.start);
      if (!match.converged || match.sigma > 0.25) continue;
      const double error = match.warp[0] - with.Truth(place.x, place.y);
      ++count;
      within += std::abs(error) < match.sigma ? 1 : 0;
      squares += error * error;
      predicted += match.sigma * match.sigma;
    }
  }
  EXPECT_GT(count, 900);
  EXPECT_NEAR(static_cast<double>(within) / count, 0.68, 0.08);
  EXPECT_NEAR(std::sqrt(predicted / squares), 1, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Textures, Sigma,
                         testing::Values(Texture{20, 3, 0, 0.8}, Texture{20, 1.2, 0, 1.2},
                                         Texture{20, 3, 0.7, 0.8}, Texture{10, 3, 0.7, 0.8},
                                         Texture{6, 3, 1, 0.8}, Texture{5, 1.2, 0.7, 1},
                                         Texture{20, 3, 1, 0.8, WarpKind::kQuadratic, 21},
                                         Texture{20, 3, 1, 0.8, WarpKind::kAffine}));

}  // namespace
}  // namespace frond
