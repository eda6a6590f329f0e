// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"
#include "problems/stereo/stereo_matcher.h"

namespace frond {

// The disparities about a window: δ(ξ, η) = δ₀ + slope_x ξ + slope_y η + ½ xx ξ² + xy ξη + ½ yy η².
struct DisparityPatch {
  double slope_x = 0, slope_y = 0;
  double xx = 0, xy = 0, yy = 0;
};

// The accepted windows of a pair by their place in the grid.
class AcceptedWindows {
 public:
  AcceptedWindows(const StereoMatches& matches, int width, int height);

  // Through the accepted windows within `reach` steps that lie on the same surface, weighted by 1/σ²: a
  // quadratic from 12 of them, a plane from 6, else the window's own plane.
  DisparityPatch PatchAt(const MatchedWindow& window, int reach) const;

 private:
  const StereoMatches& matches_;
  int step_;
  Raster<int> numbers_;  // of the windows; −1 where none is accepted
};

// What a plane fitted to the patch's curvature has at the centre of a window of `size` pixels a side, over
// its pixels inside `mask` (empty: all).
double PlaneOffset(const DisparityPatch& patch, const Mask& mask, int x, int y, int size);

}  // namespace frond
