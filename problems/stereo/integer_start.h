// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "models/raster.h"
#include "problems/stereo/match_options.h"

namespace frond {

// The disparities, to a pixel, that windows start from; NaN: none.
struct IntegerStart {
  Image disparity = {};
  std::array<int, 2> range{0, 0};  // searched: smallest and largest disparity
};

// By semi-global matching (OpenCV's) or pyramid correlation, of a rectified pair. `range` empty: from the
// disparities of a much reduced pair, some pixels wider. InputError where nothing matches there.
IntegerStart StartDisparities(const Image& left, const Image& right, const Mask& left_mask,
                              const Mask& right_mask, MatchStart start,
                              const std::optional<std::array<int, 2>>& range, int threads);

// Smallest and largest disparity of a reduced pair, but for a share of 1/200 at each end, widened.
std::array<int, 2> DisparityRange(const Image& left, const Image& right, const Mask& left_mask,
                                  const Mask& right_mask, int threads);

// OpenCV's StereoSGBM (Hirschmüller's method with block costs) with the settings of its documentation.
Image SemiGlobalDisparity(const Image& left, const Image& right, const std::array<int, 2>& range);

}  // namespace frond
