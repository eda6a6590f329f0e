// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/options.h"
#include "problems/turntable/turntable_renderer.h"

namespace frond {

// All that fixes a synthetic session at the turntable. Lengths in mm, angles in degrees.
struct SyntheticTurntableOptions {
  std::uint64_t seed = 1;  // of speckle, noise, angle errors and free board poses
  PearShape pear;
  double offset = 2;  // of the pear's foot from the axis

  double distance = 600;  // of the camera's centre from the axis
  double focal = 2000;    // pixels
  int width = 900, height = 700;
  double tilt = 10;  // the camera looks down by it, at the middle of the pear's height on the axis
  double roll = 0;
  double k1 = -0.12, k2 = 0.05, p1 = 0.0005, p2 = -0.0003;

  int pairs = 24;          // round a full turn
  double phi = 4;          // between the two views of a pair
  double angle_error = 0;  // standard deviation of the disk's true angle about the given one

  double grain = 1;
  double contrast = 0.3;
  double lamp_left = 40, lamp_up = 40;  // of the lamp as seen from the object, from the camera's direction
  Lighting lighting;
  Sensor sensor;
  Exposure first_exposure, second_exposure;  // of the left and the right view of each pair

  Board board{.columns = 9, .rows = 6, .square = 9};
  double board_lean = 25;  // back from upright
  double board_first = -60, board_last = 60, board_step = 10;
  int free_boards = 12;  // held anywhere before the camera, for the intrinsics
};

// A view to be rendered.
struct PlannedView {
  double angle = 0;       // as a user would write it down, degrees
  double true_angle = 0;  // degrees
  Exposure exposure;
  int pair = 0;        // number of the pair
  bool first = false;  // the pair's left view
};

struct PlannedBoard {
  std::optional<double> angle, true_angle;  // degrees; none for a free view
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
};

// The session, to be rendered view by view. Throws ConfigError on an option out of its range.
class SyntheticTurntable {
 public:
  explicit SyntheticTurntable(const SyntheticTurntableOptions& options);

  const SyntheticTurntableOptions& options() const { return options_; }
  const TurntableScene& scene() const { return scene_; }
  const TurntableRig& rig() const { return scene_.rig; }
  const std::vector<PlannedView>& views() const { return views_; }     // left, right, left, right, …
  const std::vector<PlannedBoard>& boards() const { return boards_; }  // on the disk, then the free ones

  // Each view has its own stream of noise: the order of the calls does not matter.
  SyntheticView View(std::size_t index, int threads = 1) const;
  SyntheticBoardView BoardView(std::size_t index, int threads = 1) const;

  // The pear in the disk's frame: closed, vertices exact.
  SurfaceMesh TruthMesh(int rings = 100, int around = 100) const;
  // Pear, rig and board by name, for a truth file.
  std::map<std::string, double> TruthValues() const;

 private:
  SyntheticTurntableOptions options_;
  TurntableScene scene_;
  std::vector<PlannedView> views_;
  std::vector<PlannedBoard> boards_;
};

// Options of `frond synth turntable`, and their reading.
std::vector<OptionSpec> SyntheticTurntableSpecs();
SyntheticTurntableOptions SyntheticTurntableOptionsFrom(const Options& options, std::uint64_t seed);

}  // namespace frond
