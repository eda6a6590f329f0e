// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "problems/stereo/dense_disparity.h"
#include "problems/stereo/pair_checks.h"
#include "problems/stereo/pair_matcher.h"
#include "problems/stereo/seed_propagation.h"

namespace frond {
namespace {

constexpr std::size_t kChunk = 64;  // windows

struct GridOfWindows {
  WindowGrid index;
  std::vector<MatchedWindow> windows;
};

GridOfWindows MakeGrid(const Image& left, const Mask& mask, int step) {
  GridOfWindows grid{WindowGrid((left.width + step - 1) / step, (left.height + step - 1) / step, -1), {}};
  for (int row = 0; row < grid.index.height; ++row) {
    for (int column = 0; column < grid.index.width; ++column) {
      const int x = column * step, y = row * step;
      if (!mask.empty() && !mask(x, y)) continue;
      grid.index(column, row) = static_cast<int>(grid.windows.size());
      grid.windows.push_back({.x = x, .y = y});
    }
  }
  return grid;
}

void MatchGrid(const PairMatcher& matcher, const StereoMatchOptions& options, int threads,
               GridOfWindows& grid) {
  std::vector<MatchedWindow>& windows = grid.windows;
  ParallelFor(windows.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) windows[k] = matcher.Match(windows[k].x, windows[k].y);
  });
  if (!options.propagate) return;
  PropagateSeeds(
      grid.index, options.window.warp,
      [&](std::size_t k, const WarpValues& start) {
        return matcher.MatchFrom(windows[k].x, windows[k].y, start);
      },
      threads, windows);
}

}  // namespace

StereoMatches MatchStereo(const Image& left, const Image& right, const Mask& left_mask,
                          const Mask& right_mask, const StereoMatchOptions& options, int threads,
                          const WindowSolver& solver, const std::array<std::string, 2>& names) {
  CheckStereoMatchOptions(options);
  CheckPair(left, right, left_mask, right_mask, names);
  StartMap starts = FindStarts(left, right, left_mask, right_mask, options, threads);
  if (options.rectified && !options.disparity) CheckSides(starts.u, names);
  const PairMatcher matcher(left, right, left_mask, right_mask, options, solver, std::move(starts));
  GridOfWindows grid = MakeGrid(left, left_mask, options.step);
  MatchGrid(matcher, options, threads, grid);
  StereoMatches matches{.step = options.step, .windows = std::move(grid.windows)};
  for (const MatchedWindow& window : matches.windows) {
    ++matches.counts[static_cast<std::size_t>(window.status)];
  }
  matches.disparity_range = matcher.starts().range;
  FillDisparities({grid.index, left, left_mask, right_mask, matcher.starts(), options}, threads, matches);
  return matches;
}

}  // namespace frond
