// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"
#include "problems/stereo/match_options.h"
#include "problems/stereo/matched_window.h"
#include "problems/stereo/window_method.h"

namespace frond {

// RMS slope of grey along x, over the window's pixels that belong to the object. Grey levels a pixel.
double WindowTexture(const Image& image, const Mask& mask, int size, int x, int y);

// The fit alone: kAccepted, kOutside, kNotConverged, kLowCorrelation or kUncertain.
WindowStatus JudgeFit(const WindowMatch& match, const StereoMatchOptions& options);

// Whether the start's disparities in the window (of the object; NaN left out) tell an edge in depth: more
// than 1 % of them depart from the match's disparity by more than `limit` pixels, or 20 % by more than half
// of it.
bool Straddles(const Image& start, const Mask& mask, const WindowModel& model, const MatchedWindow& window,
               double limit);

// Distance in the left image, in pixels, between the window's centre and where the match back from the right
// image sends its counterpart; infinite where the match back fails. `back` matches with the images exchanged.
double BackMatchDistance(const MatchedWindow& window, WarpKind kind, const MatchWindow& back);

}  // namespace frond
