// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turntable_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/errors.h"
#include "base/median.h"
#include "base/parallel.h"
#include "solvers/stopwatch.h"

namespace frond {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

std::vector<ViewPair> PairsOf(const std::vector<TurntableView>& views, const TurntableRig& rig,
                              const ViewPairOptions& options) {
  std::vector<double> degrees;
  std::vector<std::string> names;
  for (const TurntableView& view : views) {
    degrees.push_back(view.angle);
    names.push_back(view.name);
  }
  return FindViewPairs(degrees, names, rig, options);
}

void FindMissingMasks(const ObjectMaskOptions& options, int threads, std::vector<TurntableView>* views) {
  ParallelFor(views->size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      TurntableView& view = (*views)[i];
      if (view.mask.empty()) view.mask = FindObjectMask(view.image, options, view.name);
    }
  });
}

PairStatistics Describe(const StereoMatches& matches, const std::vector<ScanPoint>& points) {
  PairStatistics statistics;
  statistics.windows = matches.windows.size();
  statistics.points = points.size();
  std::vector<double> pixels, lengths;
  for (const MatchedWindow& window : matches.windows) {
    if (window.status == WindowStatus::kAccepted) pixels.push_back(window.match.sigma);
  }
  for (const ScanPoint& p : points) lengths.push_back(p.sigma);
  statistics.accepted = pixels.size();
  statistics.median_sigma_px = Median(std::move(pixels));
  statistics.median_sigma = Median(std::move(lengths));
  return statistics;
}

// One pair from photographs to points; its images are gone afterwards.
std::vector<ScanPoint> ScanPair(const TurntableView& left, const TurntableView& right, int number,
                                const TurntableRig& rig, const BoundingCylinder& cylinder,
                                const TurntableScanOptions& options, int threads, TurntableScan* scan) {
  const Stopwatch watch;
  const NormalPair pair = RectifyViews(left, right, rig, cylinder, threads);
  StereoMatchOptions match = options.match;
  if (!match.disparity) {
    match.disparity = {static_cast<int>(std::floor(pair.min_disparity)),
                       static_cast<int>(std::ceil(pair.max_disparity))};
  }
  const StereoMatches matches = MatchStereo(pair.left, pair.right, pair.left_mask, pair.right_mask, match,
                                            threads, options.match_solver, {left.name, right.name});
  std::vector<ScanPoint> points =
      TriangulateView(matches, pair, rig, left.angle * kRadians, number, options.cloud);
  PairStatistics statistics = Describe(matches, points);
  statistics.left_angle = left.angle;
  statistics.right_angle = right.angle;
  statistics.seconds = watch.Seconds();
  scan->pairs.push_back(statistics);
  for (const std::string& warning : matches.warnings) {
    scan->warnings.push_back(left.name + " and " + right.name + ": " + warning);
  }
  return points;
}

void CheckAccepted(const TurntableScan& scan) {
  std::size_t windows = 0, accepted = 0;
  for (const PairStatistics& pair : scan.pairs) {
    windows += pair.windows;
    accepted += pair.accepted;
  }
  if (accepted > 0) return;
  throw InputError("none of the " + std::to_string(windows) +
                   " windows of the turn is matched; check the angles (their sign too), the calibration, the "
                   "masks and the texture of the object");
}

}  // namespace

TurntableScan ScanTurntable(std::vector<TurntableView> views, const TurntableRig& rig,
                            const TurntableScanOptions& options, int threads, const PairProgress& progress) {
  StageClock clock;
  TurntableScan scan;
  const std::vector<ViewPair> pairs = PairsOf(views, rig, options.pairs);
  FindMissingMasks(options.mask, threads, &views);
  scan.cylinder = options.cylinder ? *options.cylinder : CylinderOfSilhouettes(views, rig);
  if (options.mask.background != BackgroundKind::kNone) {
    scan.silhouettes = PlanesOfSilhouettes(views, rig, threads);
  }
  clock.End("masks");

  std::vector<std::vector<ScanPoint>> clouds;
  for (const ViewPair& pair : pairs) {
    clouds.push_back(ScanPair(views[pair.left], views[pair.right], static_cast<int>(clouds.size()), rig,
                              scan.cylinder, options, threads, &scan));
    if (progress) progress(clouds.size(), pairs.size());
  }
  CheckAccepted(scan);
  CheckTurningSense(clouds);
  clock.End("match");

  if (options.refinement) {
    scan.refinement = RefinePoses(clouds, *options.refinement, threads);
    ApplyCorrections(*scan.refinement, &clouds);
    scan.overlap = scan.refinement->after;
    const auto& warnings = scan.refinement->warnings;
    scan.warnings.insert(scan.warnings.end(), warnings.begin(), warnings.end());
    clock.End("refine_poses");
  } else {
    scan.overlap = MeasureOverlaps(clouds, {}, threads);
    std::optional<std::string> warning = OverlapWarning(scan.overlap);
    if (warning) scan.warnings.push_back(*std::move(warning));
    clock.End("overlaps");
  }
  scan.cloud = MergeViews(clouds, options.merge, threads);
  clock.End("merge");
  scan.stages = clock.stages();
  return scan;
}

}  // namespace frond
