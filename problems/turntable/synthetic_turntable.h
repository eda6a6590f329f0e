// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "problems/turntable/board_renderer.h"
#include "problems/turntable/turntable_renderer.h"

namespace frond {

// All that fixes a synthetic session at the turntable. Lengths in mm, angles in degrees.
struct SyntheticTurntableOptions {
  std::uint64_t seed = 1;  // of speckle, noise, errors of the angles and free board poses

  PearShape pear = {};
  double offset = 2;  // of the pear's foot from the axis
  // Of the speckle: its lattice step, and its standard deviation over its mean. Chosen before frond's own
  // matchers were tried, so that peers come to about the errors known of them (MATH.md §3) at phi = 4, tilt =
  // 0 and no distortion: OpenCV's block matching 21 to 0.080 px (0.077), ECC to 0.062 with windows of 15 and
  // 0.068 with 21 pixels (0.064), SGBM to 0.11 (0.105) with small penalties, to 0.19 with the usual ones.
  double grain = 0.8;
  double contrast = 0.2;
  double albedo = 0.5;
  double disk_radius = 80;
  Lighting lighting = {};

  double distance = 600;  // of the camera's centre from the axis
  double focal = 2000;    // pixels
  int width = 900, height = 700;
  double tilt = 10;  // the camera looks down by it, at the axis at the middle of the pear's height
  double roll = 0;
  std::array<double, 5> distortion{-0.12, 0.05, 0.0005, -0.0003, 0};  // k1, k2, p1, p2, k3
  Sensor sensor = {};

  int pairs = 24;                 // round a full turn
  double phi = 4;                 // between the two views of a pair
  double angle_error = 0;         // standard deviation of the disk's true angle about the given one
  Exposure second_exposure = {};  // of the right view of each pair

  Board board{.columns = 9, .rows = 6, .square = 9};
  double board_lean = 25;                                      // back from upright
  double board_first = -60, board_last = 60, board_step = 10;  // angles of the disk with the board on it
  int free_boards = 12;  // held anywhere before the camera, for the intrinsics
};

// Of the pear, to be rendered. Degrees.
struct PlannedView {
  double angle = 0;       // as it is written down
  double true_angle = 0;  // as the disk stands
  Exposure exposure = {};
  int pair = 0;
  bool left = false;  // of its pair: the view at the greater angle
};

// Of the board. Degrees; no angles: held before the camera.
struct PlannedBoard {
  std::optional<double> angle = {}, true_angle = {};
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
};

// A session at the turntable, to be rendered view by view.
class SyntheticTurntable {
 public:
  // Throws ConfigError on an option out of its range and for a board that does not fit into the image.
  explicit SyntheticTurntable(const SyntheticTurntableOptions& options);

  const SyntheticTurntableOptions& options() const { return options_; }
  const TurntableScene& scene() const { return scene_; }
  const TurntableRig& rig() const { return scene_.rig; }
  // Pair k stands about the angle k · 360 / pairs: its left view phi/2 above it, then the right one phi/2
  // below. In [−180, 360).
  const std::vector<PlannedView>& views() const { return views_; }
  const std::vector<PlannedBoard>& boards() const { return boards_; }  // on the disk, then the free ones

  // Each view has noise of its own: neither the order of the calls nor `threads` matters.
  SyntheticView View(std::size_t index, int threads = 1) const;
  SyntheticBoardView BoardView(std::size_t index, int threads = 1) const;

  // The pear in the disk's frame, its vertices exact. Closed.
  SurfaceMesh TruthMesh(int rings = 100, int around = 100) const;

  // Rig, pear and its measures by name, for a truth file. mm, degrees.
  std::map<std::string, double> TruthValues() const;

 private:
  void PlanViews();
  void PlanBoards();

  SyntheticTurntableOptions options_;
  TurntableScene scene_;
  std::vector<PlannedView> views_;
  std::vector<PlannedBoard> boards_;
};

// Options of `frond synth turntable`, and their reading.
std::vector<OptionSpec> SyntheticTurntableSpecs();
SyntheticTurntableOptions SyntheticTurntableOptionsFrom(const Options& options, std::uint64_t seed);

}  // namespace frond
