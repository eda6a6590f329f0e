// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "models/cubic_image.h"
#include "models/raster.h"
#include "problems/stereo/match_options.h"
#include "problems/stereo/matched_window.h"
#include "problems/stereo/window_method.h"

namespace frond {

// Starts to a pixel of both coordinates: the displacement x_left − x_right. NaN: none. `v` is empty for a
// rectified pair.
struct StartMap {
  Image u = {}, v = {};
  std::array<int, 2> range{0, 0};  // of u, searched
};

// The map of a pair by the start and range of `options`. Throws InputError where hardly anything matches.
StartMap FindStarts(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
                    const StereoMatchOptions& options, int threads);

// One pair, ready for its windows to be matched and judged one by one, from any thread. What is passed in
// must outlive it.
class PairMatcher {
 public:
  PairMatcher(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
              const StereoMatchOptions& options, const WindowSolver& solver, StartMap starts);
  PairMatcher(const PairMatcher&) = delete;
  PairMatcher& operator=(const PairMatcher&) = delete;

  // The median of the start map's 3 × 3 pixels at (x, y); none where fewer than three of them have one.
  std::optional<WarpValues> StartAt(int x, int y) const;

  // From the start map. kNoTexture and kNoStart are told before any fit.
  MatchedWindow Match(int x, int y) const;

  // From `start`, judged by every test that `options` asks for.
  MatchedWindow MatchFrom(int x, int y, const WarpValues& start) const;

  const Image& left() const { return left_; }           // smoothed
  const Mask& left_mask() const { return left_mask_; }  // without its edge
  const StartMap& starts() const { return starts_; }

 private:
  WindowStatus Judge(const MatchedWindow& window, const WarpValues& start) const;

  Mask left_mask_, right_mask_;  // without their edge
  StereoMatchOptions options_;
  StartMap starts_;
  Image left_, right_;  // smoothed
  CubicImage left_spline_, right_spline_;
  MatchWindow forward_, back_;
};

}  // namespace frond
