// SPDX-License-Identifier: BSD-3-Clause
// What a config says about matching two images, and how it becomes the matcher's own options.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "problems/stereo/window_model.h"

namespace frond {

// How each window is matched from its start (MATH.md §3).
enum class MatchMethod { kWindow, kClosedForm, kClassicalDmt, kModifiedDmt };

// Of kWindow: the structured solver (window_matcher.h), or the auto-diff cost by a registered solver.
enum class MatchDerivatives { kStructured, kAutodiff };

// Where the integer starts come from. Semi-global matching needs a rectified pair.
enum class MatchStart { kSgbm, kPyramid };

// Defaults suit the turntable and any rectified pair. Lengths are pixels of the normal images.
struct StereoMatchOptions {
  WindowModel window = {.smoothing = 0.7};
  // false: the images are not normal (a deformed specimen): displacements in x and y by the affine warp.
  bool rectified = true;
  int step = 4;  // between the centres of windows, both ways
  MatchMethod method = MatchMethod::kWindow;
  MatchDerivatives derivatives = MatchDerivatives::kStructured;
  double start_box = 1;  // half the box about a start in which solvers such as pso search
  MatchStart start = MatchStart::kSgbm;
  // Smallest and largest disparity x_left − x_right, may be negative; none: found from the images, and a pair
  // whose disparities are all negative is refused as swapped. Not rectified: the largest |displacement|.
  std::optional<std::array<int, 2>> disparity = std::nullopt;
  bool propagate = true;         // windows without a good match start again from their neighbours'
  int edge = 1;                  // of the masks: pixels that take no part, object and background mixed
  double min_texture = 0.3;      // RMS slope of grey along x in the window, grey levels a pixel
  double min_correlation = 0.8;  // of the window and its counterpart after the fit
  double max_sigma = 0.2;        // of the disparity
  double left_right = 0.5;       // largest difference of the match back from the right image; 0: no check
  double discontinuity = 1;      // largest departure of the start's disparities from the window's plane
  bool curvature = true;         // of a linear warp: the bias of planes on curved surfaces is taken off
  bool interpolate = true;       // between accepted windows
};

// `match.*`, or of another prefix.
std::vector<OptionSpec> StereoMatchSpecs(const std::string& prefix = "match.");
StereoMatchOptions StereoMatchOptionsFrom(const Options& options, const std::string& prefix = "match.");

// Throws ConfigError for values that do not go together.
void CheckStereoMatchOptions(const StereoMatchOptions& options, const std::string& prefix = "match.");

}  // namespace frond
