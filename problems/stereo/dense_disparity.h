// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"
#include "problems/stereo/pair_matcher.h"
#include "problems/stereo/seed_propagation.h"
#include "problems/stereo/stereo_matcher.h"

namespace frond {

void FillDisparities(const WindowGrid& grid, const Image& left, const Mask& left_mask, const Mask& right_mask,
                     const StartMap& starts, const StereoMatchOptions& options, int threads,
                     StereoMatches& matches);

}  // namespace frond
