// SPDX-License-Identifier: BSD-3-Clause
// The fast way to match windows: Gauss-Newton with the exact Jacobian of the cost that window_fit.h minimises
// by auto-diff, with the same minimum. MATH.md §3.
#pragma once

#include "models/cubic_image.h"
#include "models/raster.h"
#include "problems/stereo/interpolation_noise.h"
#include "problems/stereo/window_model.h"

namespace frond {

struct WindowMatcherOptions {
  int max_iterations = 30;
  double tolerance = 1e-6;  // px: the change of the disparity anywhere in the window by the last step
};

class WindowMatcher {
 public:
  // All must outlive the matcher; an empty mask is all ones. Throws ConfigError for a window that is not odd
  // or has fewer than 3 pixels a side, InputError for images or masks of different sizes.
  WindowMatcher(const Image& left, const Mask& left_mask, const CubicImage& right, const Mask& right_mask,
                WindowModel model, WindowMatcherOptions options = {});

  // The window centred on (x, y) of the left image, from the warp `start`. Re-entrant; allocates nothing.
  WindowMatch Match(int x, int y, const WarpValues& start) const;

  const WindowModel& model() const { return model_; }

 private:
  WindowImages images_;
  WindowModel model_;
  WindowMatcherOptions options_;
  InterpolationNoise noise_;
};

}  // namespace frond
