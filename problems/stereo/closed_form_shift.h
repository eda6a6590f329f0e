// SPDX-License-Identifier: BSD-3-Clause
// The sub-pixel shift of a window in closed form (Psarakis and Evangelidis 2005; MATH.md §3): the right
// window between two whole shifts d − 1 and d is w_d + τ (w_d − w_{d−1}), τ in (−1, 0], and the τ that
// correlates best with the left window is a ratio of correlations.
#pragma once

#include "models/raster.h"
#include "problems/stereo/window_model.h"

namespace frond {

struct ClosedFormShift {
  bool found = false;
  double disparity = 0;    // px
  double correlation = 0;  // of the left window with the interpolated right one
};

// τ and the correlation for ρ_d = corr(w_d, L), ρ_m = corr(w_{d−1}, L), r = corr(w_d, w_{d−1}) and
// λ = |w_{d−1}| / |w_d|; not found where the best τ is outside of (−1, 0] or a maximum does not exist.
ClosedFormShift BestShiftBetween(double rho_d, double rho_m, double r, double lambda);

// The best of the intervals beside the integer disparity `disparity`, [d − 1, d] and [d, d + 1], or d itself.
// `right` is the right image itself. Pixels of the window outside of the masks, or of the right image at any
// of the three shifts, do not take part; fewer than a third, or a flat window: not found.
ClosedFormShift MatchClosedForm(const Image& left, const Mask& left_mask, const Image& right,
                                const Mask& right_mask, int size, int x, int y, int disparity);

}  // namespace frond
