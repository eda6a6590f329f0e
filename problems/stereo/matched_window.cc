// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/matched_window.h"

#include <array>

namespace frond {

const char* WindowStatusName(WindowStatus status) {
  static constexpr std::array<const char*, kWindowStatuses> kNames = {
      "accepted",        "outside",   "no_texture", "no_start",      "not_converged",
      "low_correlation", "uncertain", "left_right", "discontinuity",
  };
  return kNames[static_cast<std::size_t>(status)];
}

WarpValues ExtrapolatedWarp(WarpKind kind, const WarpValues& warp, double dx, double dy) {
  WarpValues moved = warp;
  if (kind == WarpKind::kShift) return moved;
  moved[0] += warp[1] * dx + warp[2] * dy;
  if (kind == WarpKind::kQuadratic) {
    moved[0] += warp[3] * dx * dx + warp[4] * dx * dy + warp[5] * dy * dy;
    moved[1] += 2 * warp[3] * dx + warp[4] * dy;
    moved[2] += warp[4] * dx + 2 * warp[5] * dy;
  }
  if (kind == WarpKind::kAffine) moved[3] += warp[4] * dx + warp[5] * dy;
  return moved;
}

}  // namespace frond
