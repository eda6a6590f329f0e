// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/pair_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "models/smoothing.h"
#include "problems/stereo/integer_start.h"
#include "problems/stereo/mask_edge.h"
#include "problems/stereo/match_acceptance.h"
#include "problems/stereo/pyramid_correlation.h"

namespace frond {
namespace {

constexpr double kFarFromStart = 3;  // pixels: a fit that went further has found another place
constexpr int kFewestStarts = 3;     // of 3 × 3
constexpr std::size_t kFewestMatches = 20;

// Largest displacement that is searched for, where none is given: an eighth of the smaller side.
constexpr int kSearchedPart = 8;

}  // namespace

StartMap FindStarts(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
                    const StereoMatchOptions& options, int threads) {
  StartMap starts;
  if (options.rectified) {
    IntegerStart start =
        StartDisparities(left, right, left_mask, right_mask, options.start, options.disparity, threads);
    starts.u = std::move(start.disparity);
    starts.range = start.range;
    return starts;
  }
  const int far = std::min(left.width, left.height) / kSearchedPart;
  const std::array<int, 2> range = options.disparity.value_or(std::array<int, 2>{-far, far});
  IntegerDisplacements found = CorrelatePyramid(left, right, left_mask, right_mask,
                                                {{-range[1], -range[0]}, {-range[1], -range[0]}}, 0, threads);
  const auto matches = std::count_if(found.u.values.begin(), found.u.values.end(),
                                     [](float value) { return !std::isnan(value); });
  if (static_cast<std::size_t>(matches) < kFewestMatches) {
    throw InputError("the images have hardly anything in common: " + std::to_string(matches) +
                     " places match; check that they show the same object, or widen the range searched");
  }
  for (float& value : found.u.values) value = -value;
  for (float& value : found.v.values) value = -value;
  return {.u = std::move(found.u), .v = std::move(found.v), .range = range};
}

PairMatcher::PairMatcher(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
                         const StereoMatchOptions& options, const WindowSolver& solver, StartMap starts)
    : left_mask_(WithoutEdge(left_mask, options.edge)),
      right_mask_(WithoutEdge(right_mask, options.edge)),
      options_(options),
      starts_(std::move(starts)),
      left_(Smoothed(left, left_mask_, options.window.smoothing)),
      right_(Smoothed(right, right_mask_, options.window.smoothing)),
      right_spline_(right_),
      forward_(
          MakeMatchWindow({&left_, &left_mask_, &right_spline_, &right_mask_}, right_, options, solver)) {
  if (options.left_right <= 0) return;
  left_spline_ = CubicImage(left_);
  back_ = MakeMatchWindow({&right_, &right_mask_, &left_spline_, &left_mask_}, left_, options, solver);
}

std::optional<WarpValues> PairMatcher::StartAt(int x, int y) const {
  std::array<float, 9> u{}, v{};
  std::size_t count = 0;
  for (int row = y - 1; row <= y + 1; ++row) {
    for (int column = x - 1; column <= x + 1; ++column) {
      if (!starts_.u.Contains(column, row) || std::isnan(starts_.u(column, row))) continue;
      if (!starts_.v.empty()) v[count] = starts_.v(column, row);
      u[count++] = starts_.u(column, row);
    }
  }
  if (count < kFewestStarts) return std::nullopt;
  const auto median = [count](std::array<float, 9>& values) {
    std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
    return static_cast<double>(values[count / 2]);
  };
  WarpValues start{median(u)};
  if (!starts_.v.empty()) start[3] = median(v);
  return start;
}

MatchedWindow PairMatcher::Match(int x, int y) const {
  const int size = options_.window.size;
  if (WindowTexture(left_, left_mask_, size, x, y) < options_.min_texture) {
    return {.x = x, .y = y, .status = WindowStatus::kNoTexture};
  }
  const std::optional<WarpValues> start = StartAt(x, y);
  if (!start) return {.x = x, .y = y, .status = WindowStatus::kNoStart};
  return MatchFrom(x, y, *start);
}

MatchedWindow PairMatcher::MatchFrom(int x, int y, const WarpValues& start) const {
  MatchedWindow window{.x = x, .y = y, .match = forward_(x, y, start)};
  window.status = Judge(window, start);
  return window;
}

WindowStatus PairMatcher::Judge(const MatchedWindow& window, const WarpValues& start) const {
  const WindowStatus fit = JudgeFit(window.match, options_);
  if (fit != WindowStatus::kAccepted) return fit;
  const double dx = window.match.warp[0] - start[0],
               dy = starts_.v.empty() ? 0 : window.match.warp[3] - start[3];
  if (std::hypot(dx, dy) > kFarFromStart) return WindowStatus::kNotConverged;
  if (options_.rectified && options_.discontinuity > 0 &&
      Straddles(starts_.u, left_mask_, options_.window, window, options_.discontinuity)) {
    return WindowStatus::kDiscontinuity;
  }
  if (options_.left_right > 0 &&
      !(BackMatchDistance(window, options_.window.warp, back_) <= options_.left_right)) {
    return WindowStatus::kLeftRight;
  }
  return WindowStatus::kAccepted;
}

}  // namespace frond
