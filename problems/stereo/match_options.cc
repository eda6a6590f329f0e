// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/match_options.h"

#include "base/errors.h"
#include "base/option_specs.h"
#include "models/smoothing.h"

namespace frond {
namespace {

constexpr double kFar = 100000;  // pixels

OptionSpec DisparitySpec(const std::string& name) {
  return {.name = name,
          .type = OptionType::kIntegers,
          .default_value = std::string("auto"),
          .help =
              "Smallest and largest disparity x_left - x_right searched, may be negative; auto: from the "
              "images",
          .minimum = -kFar,
          .maximum = kFar,
          .words = {"auto"},
          .min_size = 2,
          .max_size = 2};
}

// With `first`, the default, in front of the other names.
std::vector<std::string> DefaultFirst(const std::vector<std::string>& names, const std::string& first) {
  std::vector<std::string> words = {first};
  for (const std::string& name : names) {
    if (name != first) words.push_back(name);
  }
  return words;
}

}  // namespace

std::vector<OptionSpec> StereoMatchSpecs(const std::string& prefix) {
  const StereoMatchOptions defaults;
  return {
      IntegerSpec(prefix + "window", defaults.window.size, 3, kMaxWindowSize,
                  "Pixels a side of the windows that are matched; odd"),
      ChoiceSpec(prefix + "warp", DefaultFirst(WarpNames(), "linear"),
                 "How the disparity changes within a window; affine: displacements in x and y, of a pair "
                 "that is not rectified"),
      ChoiceSpec(prefix + "radiometry", DefaultFirst(RadiometryNames(), "planar_gain"),
                 "How the right image's grey follows from the left one's within a window"),
      NumberSpec(
          prefix + "smoothing", defaults.window.smoothing, 0, kLargestSmoothing,
          "Standard deviation, in pixels, of the Gaussian that smooths both images before the fit: takes "
          "off noise that texture does not have"),
      FlagSpec(prefix + "rectified", defaults.rectified,
               "A point lies in the same row of both images; no: a specimen before and after, with the "
               "affine warp"),
      IntegerSpec(prefix + "step", defaults.step, 1, 1000, "Pixels between the centres of windows"),
      ChoiceSpec(prefix + "method", {"window", "closed_form", "classical_dmt", "modified_dmt"},
                 "window: least squares over warp and radiometry; closed_form: sub-pixel shift of best "
                 "correlation; the differential technique, gain fixed at 1 or free"),
      ChoiceSpec(prefix + "derivatives", {"structured", "autodiff"},
                 "structured: the fast matcher; autodiff: every window a fit by the solver of the config"),
      NumberSpec(prefix + "start_box", defaults.start_box, 0, 100,
                 "Half the box of disparities about a start in which solvers such as pso search; 0: none"),
      ChoiceSpec(prefix + "start", {"sgbm", "pyramid"},
                 "Starts to a pixel: semi-global matching (rectified pairs), or correlation from coarse to "
                 "fine"),
      DisparitySpec(prefix + "disparity"),
      FlagSpec(prefix + "propagate", defaults.propagate,
               "Windows without a good match start again from their neighbours'"),
      IntegerSpec(prefix + "edge", defaults.edge, 0, 100,
                  "Width of a mask's edge, in pixels, where object and background mix: it takes no part"),
      NumberSpec(prefix + "min_texture", defaults.min_texture, 0, 255,
                 "Least RMS slope of grey along x in a window, grey levels a pixel"),
      NumberSpec(prefix + "min_correlation", defaults.min_correlation, -1, 1,
                 "Least correlation of a window with its counterpart"),
      NumberSpec(prefix + "max_sigma", defaults.max_sigma, 0, kFar,
                 "Largest standard deviation of a disparity, pixels"),
      NumberSpec(prefix + "left_right", defaults.left_right, 0, kFar,
                 "Largest difference, in pixels, of the match back from the right image; 0: not matched "
                 "back"),
      NumberSpec(prefix + "discontinuity", defaults.discontinuity, 0, kFar,
                 "Departure of disparities from a window's plane, in pixels, that tells an edge in depth; 0: "
                 "no such check"),
      FlagSpec(prefix + "curvature", defaults.curvature,
               "Take off the bias that the planes of a linear warp have on a curved surface, by the "
               "disparities of the windows round each"),
      FlagSpec(prefix + "interpolate", defaults.interpolate,
               "A disparity for the pixels between accepted windows too"),
  };
}

StereoMatchOptions StereoMatchOptionsFrom(const Options& options, const std::string& prefix) {
  StereoMatchOptions match;
  match.window = {.size = options.Integer(prefix + "window"),
                  .warp = WarpFrom(options.Text(prefix + "warp")),
                  .radiometry = RadiometryFrom(options.Text(prefix + "radiometry")),
                  .smoothing = options.Number(prefix + "smoothing")};
  match.rectified = options.Flag(prefix + "rectified");
  if (!match.rectified && !options.IsSet(prefix + "warp")) match.window.warp = WarpKind::kAffine;
  match.step = options.Integer(prefix + "step");
  const std::string& method = options.Text(prefix + "method");
  match.method = method == "closed_form"     ? MatchMethod::kClosedForm
                 : method == "classical_dmt" ? MatchMethod::kClassicalDmt
                 : method == "modified_dmt"  ? MatchMethod::kModifiedDmt
                                             : MatchMethod::kWindow;
  if (match.method == MatchMethod::kClosedForm && !options.IsSet(prefix + "warp")) {
    match.window.warp = WarpKind::kShift;
  }
  match.derivatives = options.Text(prefix + "derivatives") == "autodiff" ? MatchDerivatives::kAutodiff
                                                                         : MatchDerivatives::kStructured;
  match.start_box = options.Number(prefix + "start_box");
  match.start = options.Text(prefix + "start") == "pyramid" || !match.rectified ? MatchStart::kPyramid
                                                                                : MatchStart::kSgbm;
  if (!options.HoldsWord(prefix + "disparity")) {
    const std::vector<int> range = options.Integers(prefix + "disparity");
    match.disparity = {range[0], range[1]};
  }
  match.propagate = options.Flag(prefix + "propagate");
  match.edge = options.Integer(prefix + "edge");
  match.min_texture = options.Number(prefix + "min_texture");
  match.min_correlation = options.Number(prefix + "min_correlation");
  match.max_sigma = options.Number(prefix + "max_sigma");
  match.left_right = options.Number(prefix + "left_right");
  match.discontinuity = options.Number(prefix + "discontinuity");
  match.curvature = options.Flag(prefix + "curvature");
  match.interpolate = options.Flag(prefix + "interpolate");
  return match;
}

void CheckStereoMatchOptions(const StereoMatchOptions& options, const std::string& prefix) {
  const std::string option = "option '" + prefix;
  if (options.window.size % 2 == 0) {
    throw ConfigError(option + "window' is " + std::to_string(options.window.size) +
                      ", a window has a centre pixel: give an odd number");
  }
  const bool affine = options.window.warp == WarpKind::kAffine;
  if (options.rectified == affine) {
    throw ConfigError(option + "warp' " +
                      (affine ? "affine is for pairs that are not rectified: set '" + prefix +
                                    "rectified: false', or another warp"
                              : "must be affine where '" + prefix + "rectified' is false"));
  }
  if (options.method == MatchMethod::kClosedForm && options.window.warp != WarpKind::kShift) {
    throw ConfigError(option + "method' closed_form finds a shift alone: set '" + prefix + "warp: shift'");
  }
  if (options.method != MatchMethod::kWindow && options.derivatives == MatchDerivatives::kAutodiff) {
    throw ConfigError(option + "derivatives' belongs to '" + prefix + "method: window'");
  }
  if (options.disparity && (*options.disparity)[0] >= (*options.disparity)[1]) {
    throw ConfigError(option + "disparity' is [" + std::to_string((*options.disparity)[0]) + ", " +
                      std::to_string((*options.disparity)[1]) + "], the smaller must come first");
  }
}

}  // namespace frond
