// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/rectification.h"
#include "problems/turntable/board.h"
#include "solvers/solver.h"

namespace frond {

// One board seen by both cameras.
struct BoardPair {
  BoardCorners left = {}, right = {};
  std::string name = {};  // for messages: its file
};

struct StereoCalibrationOptions {
  bool square_pixels = false;         // fx = fy of each camera
  bool tangential_distortion = true;  // p1, p2
  int radial_distortion = 3;          // how many of k1, k2, k3
  bool same_focal_length = false;     // of both cameras
  double robust_width = 0;            // px: of a Huber loss on each corner's distance; 0: none
  int threads = 1;
};

struct StereoCalibration {
  StereoPair pair;
  // Standard deviations, 0 where held: fx, fy, cx, cy, k1, k2, p1, p2, k3 of each camera; rotation vector
  // (radians) and translation (unit) of right_from_left.
  std::array<double, 9> left_sigma{}, right_sigma{};
  std::array<double, 6> pose_sigma{};
  double rms = 0;                               // of the distance between corner and projected point, px
  std::vector<std::array<double, 2>> view_rms;  // left, right; px
  std::vector<std::string> warnings;
  SolverReport report;
};

// Two cameras from at least 3 pairs of board views by Ceres: both cameras, their relative pose and every
// board's pose, started from OpenCV's calibrateCamera of each. Images of width × height pixels. Throws
// InputError as CalibrateIntrinsics does, FitError where the fit fails.
StereoCalibration CalibrateStereo(const std::vector<BoardPair>& pairs, int width, int height,
                                  const StereoCalibrationOptions& options);

}  // namespace frond
