// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/stereo/window_model.h"

namespace frond {

// A window of the left image, row by row with rows padded to `stride`, and which of its pixels take part: in
// the left image and its mask, their counterparts at a warp in the right image and its mask. The choice is
// fixed while a warp is sought, so that the cost is smooth. Lies on the stack.
struct WindowPatch {
  static constexpr int kLanes = 4;
  static constexpr int kMaxStride = (kMaxWindowSize + kLanes - 1) / kLanes * kLanes;
  static constexpr int kMaxPixels = kMaxWindowSize * kMaxStride;

  int x, y;                               // the centre
  int size;                               // pixels a side
  int half;                               // (size − 1) / 2
  int stride;                             // of a row, a multiple of kLanes
  int pixels;                             // that take part
  alignas(32) double level[kMaxPixels];   // L; 0 where the pixel does not take part
  alignas(32) double weight[kMaxPixels];  // 1 or 0: takes part or not

  void Load(const WindowImages& images, const WindowModel& model, int centre_x, int centre_y,
            const WarpValues& warp);
  // Chooses anew; whether the choice differs from before.
  bool Choose(const WindowImages& images, WarpKind kind, const WarpValues& warp);

  // Fewer than a third of the window's pixels cannot be matched.
  bool HasEnoughPixels() const { return 3 * pixels >= size * size; }
};

}  // namespace frond
