// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/seed_propagation.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"

namespace frond {
namespace {

struct Attempt {
  std::size_t window = 0;
  std::size_t seed = 0;
};

bool MayTry(const MatchedWindow& window) {
  return window.status != WindowStatus::kAccepted && window.status != WindowStatus::kNoTexture;
}

// For each window next to one of `fresh`, the surest of those.
std::vector<Attempt> AttemptsBeside(const WindowGrid& grid, const std::vector<char>& fresh,
                                    std::span<const MatchedWindow> windows) {
  std::vector<Attempt> attempts;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const int index = grid(column, row);
      if (index < 0 || !MayTry(windows[static_cast<std::size_t>(index)])) continue;
      int best = -1;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          if (!grid.Contains(column + i, row + j)) continue;
          const int near = grid(column + i, row + j);
          if (near < 0 || !fresh[static_cast<std::size_t>(near)]) continue;
          if (best < 0 || windows[static_cast<std::size_t>(near)].match.sigma <
                              windows[static_cast<std::size_t>(best)].match.sigma) {
            best = near;
          }
        }
      }
      if (best >= 0) attempts.push_back({static_cast<std::size_t>(index), static_cast<std::size_t>(best)});
    }
  }
  return attempts;
}

}  // namespace

std::size_t PropagateSeeds(const WindowGrid& grid, WarpKind kind, const TryWindow& try_window, int threads,
                           std::span<MatchedWindow> windows) {
  std::vector<char> fresh(windows.size());
  for (std::size_t k = 0; k < windows.size(); ++k) {
    fresh[k] = windows[k].status == WindowStatus::kAccepted ? 1 : 0;
  }
  for (std::size_t won = 0;;) {
    const std::vector<Attempt> attempts = AttemptsBeside(grid, fresh, windows);
    std::vector<MatchedWindow> tried(attempts.size());
    ParallelFor(attempts.size(), 32, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const MatchedWindow &window = windows[attempts[k].window], &seed = windows[attempts[k].seed];
        tried[k] = try_window(attempts[k].window,
                              ExtrapolatedWarp(kind, seed.match.warp, window.x - seed.x, window.y - seed.y));
      }
    });
    std::fill(fresh.begin(), fresh.end(), char{0});
    std::size_t accepted = 0;
    for (std::size_t k = 0; k < attempts.size(); ++k) {
      MatchedWindow& window = windows[attempts[k].window];
      const bool is_good = tried[k].status == WindowStatus::kAccepted;
      // What became of a window without a start is told by its last try.
      if (is_good || window.status == WindowStatus::kNoStart) window = tried[k];
      if (!is_good) continue;
      fresh[attempts[k].window] = 1;
      ++accepted;
    }
    won += accepted;
    if (accepted == 0) return won;
  }
}

}  // namespace frond
