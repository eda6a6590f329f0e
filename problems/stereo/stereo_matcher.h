// SPDX-License-Identifier: BSD-3-Clause
// Two images to a disparity with a standard deviation for every pixel that both see: integer starts, a fit of
// every window, seeds that spread from good windows, acceptance, and planes between accepted windows.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "models/raster.h"
#include "problems/stereo/match_options.h"
#include "problems/stereo/matched_window.h"
#include "problems/stereo/window_method.h"

namespace frond {

struct StereoMatches {
  int step = 1;
  // Row by row: the windows at multiples of `step` whose centre belongs to the object.
  std::vector<MatchedWindow> windows = {};
  // Of the left image's size; NaN where neither accepted nor interpolated. Not rectified: the displacement u
  // in x, and `displacement_y` (else empty) beside it.
  Image disparity = {};
  Image sigma = {};  // standard deviation, pixels
  Image displacement_y = {};
  Mask interpolated = {};  // 1: a disparity, but not the centre of an accepted window
  std::array<std::size_t, kWindowStatuses> counts = {};  // windows by status
  std::array<int, 2> disparity_range = {};               // searched by the start
  std::vector<std::string> warnings = {};
};

// Masks are empty (all pixels count) or of their image's size. The same bits for any number of threads.
// Throws InputError for images that cannot be matched: of different sizes, black, saturated, without texture,
// swapped; `names` are what messages call them.
StereoMatches MatchStereo(const Image& left, const Image& right, const Mask& left_mask,
                          const Mask& right_mask, const StereoMatchOptions& options, int threads,
                          const WindowSolver& solver = {},
                          const std::array<std::string, 2>& names = {"the left image", "the right image"});

// Windows centred on `points` alone, in their order; each starts from the windows of a grid of options.step
// round it. Throws as MatchStereo does, and InputError for a point outside the left image.
std::vector<MatchedWindow> MatchPoints(const Image& left, const Image& right, const Mask& left_mask,
                                       const Mask& right_mask, std::span<const std::array<int, 2>> points,
                                       const StereoMatchOptions& options, int threads,
                                       const WindowSolver& solver = {},
                                       const std::array<std::string, 2>& names = {"the left image",
                                                                                  "the right image"});

}  // namespace frond
