// SPDX-License-Identifier: BSD-3-Clause
// Views of a board by a known camera on a known rig.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "problems/turntable/axis_calibration.h"

namespace frond {

inline constexpr double kDegree = std::numbers::pi / 180;

inline PinholeCamera ExampleCamera() {
  return {
      .width = 1280, .height = 1024, .focal = {2000, 2000, 640, 512}, .distortion = {-0.1, 0.05, 0, 0, 0}};
}

// Looking down at the disk by `tilt`, from 600 units.
inline TurntableRig ExampleRig(double tilt) {
  return RigFromAxis(ExampleCamera(), {4, 0, 600}, {0.01, -std::cos(tilt), -std::sin(tilt)});
}

// Standing on the disk 60 units up at 0 degrees, leaning back by 25 degrees, seen from its front.
inline Eigen::Isometry3d ExampleBoardOnDisk(const Board& board) {
  // The board's x to the right as the camera (at the disk's +x) sees it, y down: the disk's +y and −z.
  Eigen::Matrix3d upright;
  upright.col(0) = Eigen::Vector3d(0, 1, 0);
  upright.col(1) = Eigen::Vector3d(0, 0, -1);
  upright.col(2) = Eigen::Vector3d(-1, 0, 0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = upright * Eigen::AngleAxisd(-25 * kDegree, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Vector3d centre(0.5 * (board.columns - 1) * board.square,
                               0.5 * (board.rows - 1) * board.square, 0);
  pose.translation() = Eigen::Vector3d(8, -5, 10) - pose.linear() * centre;
  return pose;
}

inline BoardCorners SeenCorners(const PinholeCamera& camera, const Eigen::Isometry3d& camera_from_board,
                                const Board& board, double noise, Random* random) {
  BoardCorners corners{.points = BoardPoints(board), .may_be_upside_down = LooksTheSameUpsideDown(board)};
  for (const Eigen::Vector3d& point : corners.points) {
    const Eigen::Vector2d error(random->Normal(), random->Normal());
    corners.pixels.emplace_back(camera.Project(camera_from_board * point) + noise * error);
  }
  return corners;
}

// One view for each angle (degrees).
inline std::vector<AxisView> ExampleViews(const TurntableRig& rig, const Board& board,
                                          const std::vector<double>& degrees, double noise, Random* random) {
  std::vector<AxisView> views;
  for (const double degree : degrees) {
    const Eigen::Isometry3d pose = rig.CameraFromDisk(degree * kDegree) * ExampleBoardOnDisk(board);
    views.push_back({.angle = degree * kDegree,
                     .corners = SeenCorners(rig.camera, pose, board, noise, random),
                     .name = "view" + std::to_string(static_cast<int>(std::lround(degree))) + ".png"});
  }
  return views;
}

inline std::vector<double> DegreesFrom(double first, double last, int count) {
  std::vector<double> degrees;
  for (int k = 0; k < count; ++k) degrees.push_back(first + (last - first) * k / (count - 1));
  return degrees;
}

}  // namespace frond
