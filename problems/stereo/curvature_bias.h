// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "models/raster.h"
#include "problems/stereo/match_options.h"
#include "problems/stereo/matched_window.h"
#include "problems/stereo/seed_propagation.h"

namespace frond {

// A plane fitted to a window of a curved surface is off at the centre: by the mean, as the texture weighs it,
// of the disparity's second-order terms. Takes that off the disparity of every accepted window of a linear
// warp: the second derivatives come from a quadratic through the disparities of the accepted windows within
// options.window.size of it (on its side of edges in depth), the weights from the slopes of grey in `left`.
// Sigma grows by what the quadratic does not know. Windows with too few neighbours stay as they are. (A
// quadratic warp has no such bias, but twice the standard deviation.)
void RemoveCurvatureBias(const WindowGrid& grid, const Image& left, const Mask& left_mask,
                         const StereoMatchOptions& options, int threads, std::span<MatchedWindow> windows);

}  // namespace frond
