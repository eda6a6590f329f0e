// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "problems/stereo/match_options.h"
#include "problems/stereo/window_model.h"
#include "solvers/solver.h"

namespace frond {

// The solver of the auto-diff fit (MatchDerivatives::kAutodiff); not owned. None: Ceres's small solver.
struct WindowSolver {
  const Solver* solver = nullptr;
  Budget budget = {};
  std::uint64_t seed = 0;
};

// The match of the window centred on (x, y) from the warp `start`. Re-entrant.
using MatchWindow = std::function<WindowMatch(int x, int y, const WarpValues& start)>;

// By the method of `options`, with its window model. `right` is the image itself, which the closed form
// reads; the images must outlive the result.
MatchWindow MakeMatchWindow(const WindowImages& images, const Image& right, const StereoMatchOptions& options,
                            const WindowSolver& solver);

}  // namespace frond
