// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_method.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "problems/stereo/auto_diff_matcher.h"
#include "problems/stereo/closed_form_shift.h"
#include "problems/stereo/differential_matching.h"
#include "problems/stereo/window_fit.h"
#include "problems/stereo/window_matcher.h"

namespace frond {
namespace {

constexpr int kDifferentialIterations = 10;  // from an integer start one linear step is not enough

// What the closed form does not tell: with the noise that is left over, √(1 − ρ²) of the window's grey, a
// shift has the standard deviation noise / √Σ Lₓ².
void AddUncertainty(const Image& left, const Mask& mask, int size, int x, int y, WindowMatch& match) {
  double sum = 0, squares = 0, slopes = 0;
  const int half = size / 2;
  for (int row = std::max(0, y - half); row <= std::min(left.height - 1, y + half); ++row) {
    for (int column = std::max(1, x - half); column <= std::min(left.width - 2, x + half); ++column) {
      if (!mask.empty() && !mask(column, row)) continue;
      const double grey = left(column, row);
      const double slope = (left(column + 1, row) - left(column - 1, row)) / 2;
      ++match.pixels;
      sum += grey;
      squares += grey * grey;
      slopes += slope * slope;
    }
  }
  if (match.pixels == 0 || slopes <= 0) return;
  const double spread = squares - sum * sum / match.pixels;
  match.noise = std::sqrt(std::max(0.0, (1 - match.correlation * match.correlation) * spread / match.pixels));
  match.sigma = match.noise / std::sqrt(slopes);
}

MatchWindow ClosedForm(const WindowImages& images, const Image& right, int size) {
  return [images, &right, size](int x, int y, const WarpValues& start) {
    WindowMatch match;
    match.warp = start;
    const ClosedFormShift shift = MatchClosedForm(*images.left, *images.left_mask, right, *images.right_mask,
                                                  size, x, y, static_cast<int>(std::lround(start[0])));
    match.converged = shift.found;
    match.iterations = 1;
    if (!shift.found) return match;
    match.warp = {shift.disparity};
    match.correlation = shift.correlation;
    AddUncertainty(*images.left, *images.left_mask, size, x, y, match);
    return match;
  };
}

}  // namespace

MatchWindow MakeMatchWindow(const WindowImages& images, const Image& right, const StereoMatchOptions& options,
                            const WindowSolver& solver) {
  const WindowModel model = options.window;
  switch (options.method) {
    case MatchMethod::kClosedForm:
      return ClosedForm(images, right, model.size);
    case MatchMethod::kClassicalDmt:
    case MatchMethod::kModifiedDmt: {
      const DifferentialOptions differential{.method = options.method == MatchMethod::kClassicalDmt
                                                           ? DifferentialMethod::kClassical
                                                           : DifferentialMethod::kModified,
                                             .iterations = kDifferentialIterations};
      return [=](int x, int y, const WarpValues& start) {
        return MatchDifferentially(images, model, x, y, start, differential);
      };
    }
    case MatchMethod::kWindow:
      break;
  }
  if (options.derivatives == MatchDerivatives::kStructured) {
    const auto matcher = std::make_shared<WindowMatcher>(*images.left, *images.left_mask, *images.right,
                                                         *images.right_mask, model);
    return [matcher](int x, int y, const WarpValues& start) { return matcher->Match(x, y, start); };
  }
  if (!solver.solver) {
    return [=](int x, int y, const WarpValues& start) { return MatchByAutoDiff(images, model, x, y, start); };
  }
  return [=](int x, int y, const WarpValues& start) {
    // One thread: the windows themselves are spread over the threads.
    return SolveWindow(images, model, x, y, start, {.start_box = options.start_box}, *solver.solver,
                       solver.budget, {.threads = 1, .seed = solver.seed});
  };
}

}  // namespace frond
