// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"
#include "problems/stereo/pair_matcher.h"
#include "problems/stereo/seed_propagation.h"
#include "problems/stereo/stereo_matcher.h"

namespace frond {

// What dense disparities are made from. `grid` holds the windows' numbers.
struct DenseInput {
  const WindowGrid& grid;
  const Image& left;
  const Mask& left_mask;
  const Mask& right_mask;
  const StartMap& starts;
  const StereoMatchOptions& options;
};

// Fills disparity, sigma, displacement_y and interpolated of `matches` from its windows. A pixel between
// accepted windows has the mean of their planes (their warps, extrapolated), by nearness and σ; only of those
// on its side of an edge in depth: that of the start's disparity there, or of the nearest window. As far as
// half a window from an accepted one; twice as far where the start agrees or windows lie on both sides. Not
// where the right image shows another, nearer place in front, and not outside the masks.
void FillDisparities(const DenseInput& input, int threads, StereoMatches& matches);

}  // namespace frond
