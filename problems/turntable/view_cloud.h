// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "models/turntable_rig.h"
#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/scan_point.h"
#include "problems/turntable/view_images.h"

namespace frond {

struct ViewCloudOptions {
  double least_cosine = 0.15;         // more slanting windows are left out
  int normal_reach = 2;               // grid steps: a normal is that of the disparities' plane within
  bool unbend = false;                // take away what the window's plane is off by on a curved surface
  double height_above_disk = -1e300;  // points lower than this z are left out (the disk, a table)
};

// The accepted windows of a pair, in the order of the grid. The point of window (x, y, δ) is Triangulate's,
// σ is σ_δ · RangeSlope. A plane in space is a plane of disparities: with δ = δ₀ + δ₁ξ + δ₂η its normal is
// (f δ₁, f δ₂, δ₀ − cx_l + cx_r − δ₁(x − cx_l) − δ₂(y − cy)) in the normal frame; the slopes are those of the
// quadratic (or, of fewer than 12, plane) through the accepted neighbours' disparities, by 1/σ², or the
// window's own where there are fewer than 6.
//
// A window of the shift or linear warp measures the mean of a curved surface, behind a bulge: of curvature
// δ_xx + δ_yy by (n² − 1)/24 of it. `unbend` takes that away, with the quadratic's curvatures and the
// window's own pixels inside the mask.
std::vector<ScanPoint> TriangulateView(const StereoMatches& matches, const NormalPair& pair,
                                       const TurntableRig& rig, const WindowModel& window, double left_angle,
                                       int view, const ViewCloudOptions& options);

}  // namespace frond
