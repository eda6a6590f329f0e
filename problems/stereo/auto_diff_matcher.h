// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/stereo/window_model.h"

namespace frond {

// The window of WindowFit by ceres::TinySolver: the same auto-diff residuals in compressed rows, without the
// set-up of a ceres::Problem, which takes longer than to solve a window. With the result of
// WindowMatcher::Match. Re-entrant.
WindowMatch MatchByAutoDiff(const WindowImages& images, const WindowModel& model, int x, int y,
                            const WarpValues& start);

}  // namespace frond
