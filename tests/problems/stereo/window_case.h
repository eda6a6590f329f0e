// SPDX-License-Identifier: BSD-3-Clause
// A textured pair ready for matching.
#pragma once

#include <vector>

#include "base/random.h"
#include "models/smoothing.h"
#include "problems/stereo/textured_pair.h"
#include "problems/stereo/window_model.h"

namespace frond {

struct WindowCase {
  TexturedPair pair;
  Mask all;
  CubicImage right;

  explicit WindowCase(const TexturedPairOptions& options, double smoothing = 0)
      : pair(MakeTexturedPair(options)) {
    pair.left = Smoothed(pair.left, all, smoothing);
    right = CubicImage(Smoothed(pair.right, all, smoothing));
  }

  WindowImages images() const { return {&pair.left, &all, &right, &all}; }
  double Truth(int x, int y) const { return pair.Disparity(x, y); }
};

struct WindowPlace {
  int x = 0, y = 0;
  WarpValues start{};
};

// Windows every `step` pixels, inside both images, with starts within ±0.5 px of the truth.
inline std::vector<WindowPlace> Places(const WindowCase& with, int step) {
  Random random(11);
  std::vector<WindowPlace> places;
  const Image& left = with.pair.left;
  for (int y = 14; y < left.height - 14; y += step) {
    for (int x = 50; x < left.width - 30; x += step) {
      places.push_back({x, y, {with.Truth(x, y) + random.Uniform(-0.5, 0.5)}});
    }
  }
  return places;
}

}  // namespace frond
