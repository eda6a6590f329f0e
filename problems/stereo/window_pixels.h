// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "problems/stereo/window_model.h"

namespace frond {

// The pixels of a window that take part, row by row: in the left image and its mask, their counterparts at
// the warp `start` in the right image and its mask. Their number is fixed during a solve, so that the cost is
// smooth.
struct WindowPixels {
  struct Pixel {
    double xi = 0, eta = 0;  // offsets from the centre
    double level = 0;        // L
  };

  int x = 0, y = 0;  // the centre
  std::vector<Pixel> pixels = {};

  WindowPixels() = default;
  WindowPixels(const WindowImages& images, const WindowModel& model, int x, int y, const WarpValues& start);
};

}  // namespace frond
