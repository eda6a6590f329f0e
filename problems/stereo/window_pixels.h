// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "problems/stereo/window_model.h"
#include "problems/stereo/window_patch.h"
#include "problems/stereo/window_residual.h"

namespace frond {

// The pixels of a patch that take part, row by row.
std::vector<WindowPixel> PixelsOf(const WindowPatch& patch);

// Gain and offset by mean and contrast of the patch and of its counterpart at `warp`: the start of auto-diff.
RadiometryValues StartRadiometry(const WindowImages& images, const WindowModel& model, int x, int y,
                                 const std::vector<WindowPixel>& pixels, const WarpValues& warp);

}  // namespace frond
