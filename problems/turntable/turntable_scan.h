// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stage_clock.h"
#include "models/turntable_rig.h"
#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/object_mask.h"
#include "problems/turntable/pose_refinement.h"
#include "problems/turntable/silhouette_planes.h"
#include "problems/turntable/turntable_view.h"
#include "problems/turntable/view_cloud.h"
#include "problems/turntable/view_images.h"
#include "problems/turntable/view_merge.h"
#include "problems/turntable/view_pairs.h"

namespace frond {

struct TurntableScanOptions {
  ViewPairOptions pairs = {};
  ObjectMaskOptions mask = {};
  std::optional<BoundingCylinder> cylinder = {};  // default: of the silhouettes
  StereoMatchOptions match = {};                  // disparities from the cylinder unless given
  WindowSolver match_solver = {};                 // of MatchDerivatives::kAutodiff; not owned
  ViewCloudOptions cloud = {};
  std::optional<PoseRefinementOptions> refinement = {};  // none: the calibration's poses are kept
  MergeOptions merge = {};
};

// One stereo pair of the turn.
struct PairStatistics {
  double left_angle = 0, right_angle = 0;  // degrees
  std::size_t windows = 0;                 // of the grid inside the mask
  std::size_t accepted = 0;
  std::size_t points = 0;
  double median_sigma_px = 0;  // of the accepted windows' disparities
  double median_sigma = 0;     // along the ray, in the rig's unit
  double seconds = 0;
};

struct TurntableScan {
  MergedCloud cloud;  // in the disk's frame
  std::vector<PairStatistics> pairs;
  BoundingCylinder cylinder;
  std::vector<TangentPlane> silhouettes;  // for the closed surface (turned_surface.h)
  OverlapErrors overlap;                  // as merged
  std::optional<PoseRefinement> refinement;
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;
};

// After each pair: its number, of how many.
using PairProgress = std::function<void(std::size_t done, std::size_t of)>;

// Photographs of a turn to one cloud: masks → pairs → of one pair after the other: normal images, matches,
// points → corrections of the poses → merged cloud. Memory: the views and one pair's images at a time.
// Throws InputError as FindViewPairs, FindObjectMask, RectifyViews and CheckTurningSense, and where no window
// of any pair is accepted; FitError where a solver fails.
TurntableScan ScanTurntable(std::vector<TurntableView> views, const TurntableRig& rig,
                            const TurntableScanOptions& options, int threads,
                            const PairProgress& progress = {});

}  // namespace frond
