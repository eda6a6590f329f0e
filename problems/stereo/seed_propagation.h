// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "models/raster.h"
#include "problems/stereo/matched_window.h"

namespace frond {

// A grid of windows: `index` of each node in a list, −1 where there is none.
using WindowGrid = Raster<int>;

// Another try of the window `index` from `start`.
using TryWindow = std::function<MatchedWindow(std::size_t index, const WarpValues& start)>;

// Windows that were not accepted try again from the warp of the surest (least σ) of the neighbours (8) that
// were accepted since their last try, until no try succeeds. Rounds, each of them in parallel from the same
// state: the result does not depend on `threads`. Windows without texture are not tried. Returns how many
// were won.
std::size_t PropagateSeeds(const WindowGrid& grid, WarpKind kind, const TryWindow& try_window, int threads,
                           std::span<MatchedWindow> windows);

}  // namespace frond
