// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "problems/turntable/board.h"
#include "problems/turntable/camera_film.h"
#include "problems/turntable/turntable_scene.h"

namespace frond {

// A photograph of a chessboard.
struct SyntheticBoardView {
  std::optional<double> angle = {};  // of the disk that it stands on, radians; none: held before the camera
  Image image = {};
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector2d> corners = {};  // true pixels of the inner corners, row by row
};

// The sheet is one square wider than the inner corners on each side, and a white margin of 0.6 squares.
inline constexpr double kBoardMargin = 0.6;

// The board's pose in the disk's frame when it stands on the disk over the axis, leaning back by `lean`
// (radians) from upright and facing the camera at 0 degrees.
Eigen::Isometry3d StandingBoard(const TurntableScene& scene, const Board& board, double lean);

// With `angle` the empty disk below is to be seen. Throws ConfigError for a ChArUco board.
SyntheticBoardView RenderBoard(const TurntableScene& scene, const Sensor& sensor, const Board& board,
                               const Eigen::Isometry3d& camera_from_board, std::optional<double> angle,
                               Random& random, int threads = 1);

}  // namespace frond
