// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/parallel.h"
#include "problems/stereo/curvature_bias.h"
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

// The window at (x, y) from the surest of the accepted windows on the four grid nodes round it, else from the
// start map.
MatchedWindow MatchBeside(const PairMatcher& matcher, const GridOfWindows& grid,
                          const StereoMatchOptions& options, int x, int y) {
  const MatchedWindow* seed = nullptr;
  for (const int row : {y / options.step, y / options.step + 1}) {
    for (const int column : {x / options.step, x / options.step + 1}) {
      if (!grid.index.Contains(column, row) || grid.index(column, row) < 0) continue;
      const MatchedWindow& near = grid.windows[static_cast<std::size_t>(grid.index(column, row))];
      if (near.status != WindowStatus::kAccepted) continue;
      if (!seed || near.match.sigma < seed->match.sigma) seed = &near;
    }
  }
  if (seed) {
    const MatchedWindow window = matcher.MatchFrom(
        x, y, ExtrapolatedWarp(options.window.warp, seed->match.warp, x - seed->x, y - seed->y));
    if (window.status == WindowStatus::kAccepted) return window;
  }
  return matcher.Match(x, y);
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
  if (options.curvature) {
    RemoveCurvatureBias(grid.index, matcher.left(), matcher.left_mask(), options, threads, grid.windows);
  }
  StereoMatches matches{.step = options.step, .windows = std::move(grid.windows)};
  for (const MatchedWindow& window : matches.windows) {
    ++matches.counts[static_cast<std::size_t>(window.status)];
  }
  matches.disparity_range = matcher.starts().range;
  FillDisparities({grid.index, left, left_mask, right_mask, matcher.starts(), options}, threads, matches);
  return matches;
}

std::vector<MatchedWindow> MatchPoints(const Image& left, const Image& right, const Mask& left_mask,
                                       const Mask& right_mask, std::span<const std::array<int, 2>> points,
                                       const StereoMatchOptions& options, int threads,
                                       const WindowSolver& solver, const std::array<std::string, 2>& names) {
  CheckStereoMatchOptions(options);
  CheckPair(left, right, left_mask, right_mask, names);
  for (const auto& [x, y] : points) {
    if (left.Contains(x, y)) continue;
    throw InputError("the point (" + std::to_string(x) + ", " + std::to_string(y) + ") is outside " +
                     names[0] + " of " + std::to_string(left.width) + " x " + std::to_string(left.height) +
                     " pixels");
  }
  const PairMatcher matcher(left, right, left_mask, right_mask, options, solver,
                            FindStarts(left, right, left_mask, right_mask, options, threads));
  GridOfWindows grid = MakeGrid(left, left_mask, options.step);
  MatchGrid(matcher, options, threads, grid);
  std::vector<MatchedWindow> matched(points.size());
  ParallelFor(points.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      matched[k] = MatchBeside(matcher, grid, options, points[k][0], points[k][1]);
    }
  });
  return matched;
}

}  // namespace frond
