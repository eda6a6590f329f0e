// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "models/turntable_rig.h"
#include "problems/turntable/board.h"
#include "solvers/solver.h"

namespace frond {

// The board standing on the disk, the disk at `angle` (radians, counter-clockwise seen from above).
struct AxisView {
  double angle = 0;
  BoardCorners corners = {};
  std::string name = {};  // for messages: its file
};

struct AxisOptions {
  bool free_angles = false;   // a correction of each angle but the first's
  double angle_sigma = 0;     // radians: standard deviation of the table's angles, 0: unknown (no prior)
  double corner_sigma = 0.1;  // px: of the corners, weighs them against the angles' prior
  bool free_camera = false;   // focal lengths, principal point and distortion too
  int threads = 1;
};

// A value with its standard deviation.
struct Estimate {
  double value = 0;
  double sigma = 0;
};

struct AxisCalibration {
  TurntableRig rig;
  Eigen::Isometry3d disk_from_board = Eigen::Isometry3d::Identity();  // the disk at 0 degrees
  std::vector<double> angles;                                         // of each view, corrected; radians

  // Every free parameter and the covariance of all of them (σ² from the residuals):
  //   axis.direction_x, _z   radians: turns of the axis towards the directions orthogonal to it nearest to
  //   the
  //                          camera's x (in the image) and z (the viewing direction); value 0
  //   axis.point_x, _z       unit: shifts of the axis along the same; value 0
  //   board.rotation_x … z   radians: rotation vector applied after the board's pose; value 0
  //   board.position_x … z   unit: of the board's origin in the camera's frame, the disk at 0 degrees
  //   camera.fx, fy, cx, cy, k1, k2, p1, p2, k3  where free
  //   angle.VIEW             radians: correction of the view's angle, where free
  std::vector<std::string> parameter_names;
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;
  std::vector<int> angle_parameter;  // of each view: index of its angle above, -1 where held

  Estimate distance;  // the paper's d, unit
  Estimate tilt;      // radians, see TurntableRig
  Estimate roll;      // radians

  double corner_sigma = 0;             // px, per coordinate, from the residuals
  double rms = 0;                      // of the distance between corner and projected point, px
  double reversed_rms = 0;             // the same with all angles negated; infinite where no fit is found
  double free_angles_rms = 0;          // the same with every angle free
  std::vector<double> view_rms;        // px
  std::vector<Estimate> angle_errors;  // of the angles given, by a fit with all free but the first; radians
  std::vector<std::string> warnings;   // one line each: what does not fit or is too little
  std::vector<std::string> notes;      // one line each: what is good to know
  SolverReport report;                 // of the final fit
};

// The axis of turning from views of a board at 3 table angles or more, 10 and more recommended, by Ceres:
// axis direction (2) and point (2), the board's pose (6) and, where options say so, the angles and the
// camera; residuals in pixels through ProjectPinhole. Throws InputError for too few views or angles, a view
// that cannot be located, and a table that turns the other way; FitError where the fit fails.
AxisCalibration CalibrateAxis(const PinholeCamera& camera, const std::vector<AxisView>& views,
                              const AxisOptions& options);

// The paper's φ: from view `first` to view `second`, radians. Its σ is 0 where the angles are held.
Estimate TurnBetween(const AxisCalibration& calibration, int first, int second);

}  // namespace frond
