// SPDX-License-Identifier: BSD-3-Clause
// Windows a second, 15 × 15, linear disparity and planar gain, from starts within ±0.5 px as integer starts
// give: the structured way, auto-diff by ceres::TinySolver and by a ceres::Problem each; and how far they
// differ.
#include <ceres/problem.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "models/smoothing.h"
#include "problems/stereo/auto_diff_matcher.h"
#include "problems/stereo/textured_pair.h"
#include "problems/stereo/window_fit.h"
#include "problems/stereo/window_matcher.h"

namespace frond {
namespace {

struct Start {
  int x = 0, y = 0;
  WarpValues warp{};
};

using MatchOne = std::function<WindowMatch(const Start&)>;

struct Row {
  const char* name;
  double seconds = 0;
  std::vector<WindowMatch> matches;
};

Row Run(const char* name, const std::vector<Start>& starts, int threads, const MatchOne& match) {
  Row row{.name = name, .matches = std::vector<WindowMatch>(starts.size())};
  const auto begin = std::chrono::steady_clock::now();
  ParallelFor(starts.size(), 64, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) row.matches[i] = match(starts[i]);
  });
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return row;
}

void Print(const Row& row, const Row& first, const TexturedPair& pair, const std::vector<Start>& starts) {
  double largest = 0, squares = 0, iterations = 0;
  int converged = 0, within = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const WindowMatch& match = row.matches[i];
    if (!match.converged) continue;
    ++converged;
    iterations += match.iterations;
    const double error = match.warp[0] - pair.Disparity(starts[i].x, starts[i].y);
    squares += error * error;
    within += std::abs(error) < match.sigma ? 1 : 0;
    if (first.matches[i].converged) {
      largest = std::max(largest, std::abs(match.warp[0] - first.matches[i].warp[0]));
    }
  }
  std::printf("| %s | %.0f | %.1f | %d of %zu | %.4f | %.1f %% | %.1e |\n", row.name,
              static_cast<double>(starts.size()) / row.seconds, iterations / converged, converged,
              starts.size(), std::sqrt(squares / converged), 100.0 * within / converged, largest);
}

void Bench(double contrast, double smoothing) {
  TexturedPair pair = MakeTexturedPair({.width = 640, .height = 320, .contrast = contrast});
  const Mask all;
  pair.left = Smoothed(pair.left, all, smoothing);
  const CubicImage right(Smoothed(pair.right, all, smoothing));
  const WindowModel model{.smoothing = smoothing};
  const WindowImages images{&pair.left, &all, &right, &all};
  std::vector<Start> starts;
  Random random(1);
  for (int y = 12; y < pair.left.height - 12; y += 3) {
    for (int x = 60; x < pair.left.width - 60; x += 3) {
      starts.push_back({.x = x, .y = y, .warp = {pair.Disparity(x, y) + random.Uniform(-0.5, 0.5)}});
    }
  }
  const WindowMatcher matcher(pair.left, all, right, all, model);
  const MatchOne fast = [&](const Start& s) { return matcher.Match(s.x, s.y, s.warp); };
  const MatchOne tiny = [&](const Start& s) { return MatchByAutoDiff(images, model, s.x, s.y, s.warp); };
  const SolverType& lm = FindSolverType("lm");
  Options options(lm.options);
  options.Set("function_tolerance", 1e-14);
  const std::unique_ptr<Solver> solver = lm.create(options);
  const MatchOne problem = [&](const Start& s) {
    return SolveWindow(images, model, s.x, s.y, s.warp, {}, *solver, {.max_evaluations = 10000}, {});
  };

  std::printf("\nTexture of %.0f grey levels, noise of 1.5 in both images, smoothed by %.1f px:\n\n",
              contrast, smoothing);
  std::printf(
      "| way | windows/s | iterations | converged | RMSE px | within 1 sigma | largest difference px |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  const Row first = Run("structured, 1 thread", starts, 1, fast);
  Print(first, first, pair, starts);
  Print(Run("structured, 2 threads", starts, 2, fast), first, pair, starts);
  Print(Run("auto-diff, ceres::TinySolver", starts, 1, tiny), first, pair, starts);
  Print(Run("auto-diff, ceres::Problem, solver lm", starts, 1, problem), first, pair, starts);
}

}  // namespace
}  // namespace frond

int main() {
  frond::Bench(20, 0);
  frond::Bench(20, 0.7);
  frond::Bench(8, 0.7);
}
