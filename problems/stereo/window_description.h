// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/stereo/window_model.h"

namespace frond {

// The match at a warp as it is: the best radiometry there, noise, correlation and sigma. Of too few pixels,
// or a flat window, `pixels` alone, and not `converged`.
WindowMatch DescribeWindow(const WindowImages& images, const WindowModel& model, int x, int y,
                           const WarpValues& warp);

}  // namespace frond
