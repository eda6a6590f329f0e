// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "problems/turntable/scan_point.h"

namespace frond {

// kAngle: each view's turn about the disk's axis; kPose: all of its pose.
enum class PoseFreedom { kAngle, kPose };

struct PoseRefinementOptions {
  PoseFreedom freedom = PoseFreedom::kPose;
  double angle_deviation = 0.1;          // degrees: what a correction is expected to be (a weak prior, as a
                                         // body of revolution says nothing about the angle)
  double position_deviation = 0.002;     // share of the object's size
  std::size_t points_per_overlap = 400;  // at most, of each two views
  double independent_points = 20;        // what the points of an overlap count as: their errors go together
  double least_cosine = 0.4;  // of the viewing angle: slanting windows are off by more than their σ
  int repetitions = 6;        // of finding the nearest points
  double reach = 3;           // in spacings: how far apart two views of one surface may be
};

// How two views' points of the same surface lie to each other, over all overlaps.
struct OverlapErrors {
  std::size_t overlaps = 0;  // pairs of views
  std::size_t correspondences = 0;
  double rms = 0;         // along the normals, robust (1.4826 · median), in the unit of length
  double normalised = 0;  // the same in standard deviations: about 1 where σ and poses hold
};

struct PoseRefinement {
  std::vector<Eigen::Isometry3d> correction;  // by view: a point p of the view becomes correction · p
  std::vector<double> angle;                  // by view: degrees about the axis
  std::vector<double> shift;                  // by view: of the middle of its points, in the unit of length
  OverlapErrors before, after;
  std::vector<std::string> warnings;
};

// Point to plane (Chen and Medioni 1992) between every two views that overlap, all poses at once by Ceres,
// Huber's loss, rows by 1/σ; the mean correction is held at none by the prior. Deterministic.
PoseRefinement RefinePoses(const std::vector<std::vector<ScanPoint>>& views,
                           const PoseRefinementOptions& options, int threads);
void ApplyCorrections(const PoseRefinement& refinement, std::vector<std::vector<ScanPoint>>* views);

// What to say of views that do not fit together, by more than three standard deviations.
std::optional<std::string> OverlapWarning(const OverlapErrors& errors);

OverlapErrors MeasureOverlaps(const std::vector<std::vector<ScanPoint>>& views,
                              const PoseRefinementOptions& options, int threads);

// Throws InputError where the object looks hollow from most views: normals that point to the axis are what
// angles of the wrong sign (or left and right exchanged) make of a body on a disk.
void CheckTurningSense(const std::vector<std::vector<ScanPoint>>& views);

}  // namespace frond
