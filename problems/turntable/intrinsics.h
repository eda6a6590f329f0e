// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "models/pinhole_camera.h"
#include "problems/turntable/board.h"

namespace frond {

struct IntrinsicsOptions {
  bool square_pixels = false;         // fx = fy
  bool centred = false;               // the principal point held in the middle of the image
  bool tangential_distortion = true;  // p1, p2
  int radial_distortion = 3;          // how many of k1, k2, k3
};

struct IntrinsicsCalibration {
  PinholeCamera camera;
  std::array<double, 4> focal_sigma{};  // standard deviations; 0: held
  std::array<double, 5> distortion_sigma{};
  double rms = 0;                                    // of the distance between corner and projected point, px
  std::vector<double> view_rms;                      // px
  std::vector<Eigen::Isometry3d> camera_from_board;  // of each view
  std::vector<std::string> warnings;                 // one line each; views are called by their names
};

// The camera by OpenCV's calibrateCamera (Zhang 2000) from views of a board in at least 3 positions that
// differ in their tilt. `names` are the views', for messages. Throws InputError where the views are fewer,
// are (nearly) parallel to each other, or the result is no camera.
IntrinsicsCalibration CalibrateIntrinsics(const std::vector<BoardCorners>& views,
                                          const std::vector<std::string>& names, int width, int height,
                                          const IntrinsicsOptions& options);

// The pose of a board in front of a calibrated camera. Throws InputError naming the view (fewer than 4
// corners, or corners on a line).
Eigen::Isometry3d LocateBoard(const PinholeCamera& camera, const BoardCorners& corners,
                              const std::string& name);

}  // namespace frond
