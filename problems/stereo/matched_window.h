// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "problems/stereo/window_model.h"

namespace frond {

enum class WindowStatus : std::uint8_t {
  kAccepted,
  kOutside,         // too few pixels on the object, or their counterparts outside the right image
  kNoTexture,       // grey hardly changes along x
  kNoStart,         // neither a start of its own nor a good neighbour
  kNotConverged,    // the fit, or it left its start far behind
  kLowCorrelation,  // of the window and its counterpart
  kUncertain,       // standard deviation too large
  kLeftRight,       // the match back from the right image ends elsewhere
  kDiscontinuity,   // the window straddles an edge in depth
};
inline constexpr std::size_t kWindowStatuses = 9;
const char* WindowStatusName(WindowStatus status);  // "accepted", "outside", …

struct MatchedWindow {
  int x = 0, y = 0;  // centre, in the left image
  WindowStatus status = WindowStatus::kOutside;
  WindowMatch match = {};
};

// The warp of a window as it is seen from a point (dx, dy) pixels from its centre: with [0] the disparity
// there.
WarpValues ExtrapolatedWarp(WarpKind kind, const WarpValues& warp, double dx, double dy);

}  // namespace frond
