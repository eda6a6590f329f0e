// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/synthetic_turntable.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void Require(bool holds, const char* rule) {
  if (!holds) throw ConfigError(std::string("synthetic turntable: ") + rule);
}

void CheckOptions(const SyntheticTurntableOptions& o) {
  Require(o.distance > o.pear.height, "'camera.distance' must be more than the pear's height");
  Require(o.focal > 0 && o.width >= 16 && o.height >= 16, "'camera' must have a focal length and an image");
  Require(std::abs(o.tilt) <= 60 && std::abs(o.roll) <= 45,
          "'camera.tilt' must be in [-60, 60] and 'camera.roll' in [-45, 45] degrees");
  Require(o.grain > 0 && o.contrast >= 0 && o.albedo > 0, "'texture' must have a grain and an albedo");
  Require(o.pairs >= 1 && o.phi > 0 && o.phi <= 45, "'phi' must be in (0, 45] degrees, 'pairs' at least 1");
  Require(o.sensor.supersampling >= 1 && o.sensor.blur >= 0 && o.sensor.noise >= 0,
          "'sensor.supersampling' must be at least 1, 'blur' and 'noise' at least 0");
  Require(o.board_step > 0 && o.board_first <= o.board_last, "'board' angles must go from first to last");
  CheckBoard(o.board);
}

TurntableRig MakeRig(const SyntheticTurntableOptions& o) {
  const double c = std::cos(o.tilt * kDegree), s = std::sin(o.tilt * kDegree);
  Eigen::Matrix3d rotation;  // rows: the camera's right, down and forwards in the disk's frame
  rotation << 0, 1, 0, s, 0, -c, -c, 0, -s;
  TurntableRig rig;
  rig.camera = {.width = o.width,
                .height = o.height,
                .focal = {o.focal, o.focal, (o.width - 1) / 2.0, (o.height - 1) / 2.0},
                .distortion = o.distortion};
  rig.camera_from_disk.linear() = Eigen::AngleAxisd(o.roll * kDegree, Eigen::Vector3d::UnitZ()) * rotation;
  rig.camera_from_disk.translation() = -(rig.camera_from_disk.linear() * Eigen::Vector3d(o.distance, 0, 0));
  return rig;
}

TurntableScene MakeScene(const SyntheticTurntableOptions& o) {
  Random random = Random::ForKey(o.seed, "turntable speckle");
  TurntableScene scene;
  scene.rig = MakeRig(o);
  scene.pear = SyntheticPear(o.pear);
  scene.pear_origin = {o.offset, 0, -o.distance * std::tan(o.tilt * kDegree) - o.pear.height / 2};
  scene.disk_radius = o.disk_radius;
  scene.speckle = SolidTexture(static_cast<std::uint32_t>(random.NextBits() >> 32), o.grain);
  scene.contrast = o.contrast;
  scene.albedo = o.albedo;
  scene.lighting = o.lighting;
  return scene;
}

bool InImage(const PinholeCamera& camera, const Board& board, const Eigen::Isometry3d& camera_from_board) {
  const double margin = board.square;  // the detector needs the squares beyond the corners
  for (const Eigen::Vector3d& corner : BoardPoints(board)) {
    for (const double dx : {-margin, margin}) {
      for (const double dy : {-margin, margin}) {
        const Eigen::Vector3d p = camera_from_board * (corner + Eigen::Vector3d(dx, dy, 0));
        if (!(p.z() > 0)) return false;
        const Eigen::Vector2d pixel = camera.Project(p);
        if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > camera.width - 1 || pixel.y() > camera.height - 1) {
          return false;
        }
      }
    }
  }
  return true;
}

// Anywhere in the image, near and far, leaning any way by up to 40 degrees.
Eigen::Isometry3d RandomBoardPose(const SyntheticTurntableOptions& o, const PinholeCamera& camera,
                                  Random& random) {
  const double z = o.distance * random.Uniform(0.7, 1.1);
  const Eigen::Vector3d towards =
      camera.Ray({random.Uniform(0, o.width - 1), random.Uniform(0, o.height - 1)});
  const Eigen::Vector3d turn(random.Uniform(-40, 40), random.Uniform(-40, 40), random.Uniform(-20, 20));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(turn.z() * kDegree, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(turn.y() * kDegree, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(turn.x() * kDegree, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  const Eigen::Vector3d middle((o.board.columns - 1) / 2.0 * o.board.square,
                               (o.board.rows - 1) / 2.0 * o.board.square, 0);
  pose.translation() = z * towards - pose.linear() * middle;
  return pose;
}

}  // namespace

SyntheticTurntable::SyntheticTurntable(const SyntheticTurntableOptions& options) : options_(options) {
  CheckOptions(options_);
  scene_ = MakeScene(options_);
  PlanViews();
  PlanBoards();
}

void SyntheticTurntable::PlanViews() {
  Random random = Random::ForKey(options_.seed, "turntable angles");
  for (int pair = 0; pair < options_.pairs; ++pair) {
    for (const bool left : {true, false}) {
      PlannedView view{.angle = 360.0 * pair / options_.pairs + (left ? 0.5 : -0.5) * options_.phi,
                       .pair = pair,
                       .left = left};
      view.true_angle = view.angle + options_.angle_error * random.Normal();
      if (!left) view.exposure = options_.second_exposure;
      views_.push_back(view);
    }
  }
}

void SyntheticTurntable::PlanBoards() {
  const SyntheticTurntableOptions& o = options_;
  Random random = Random::ForKey(o.seed, "turntable boards");
  const Eigen::Isometry3d standing = StandingBoard(scene_, o.board, o.board_lean * kDegree);
  const int steps = static_cast<int>(std::floor((o.board_last - o.board_first) / o.board_step + 1e-9));
  for (int i = 0; i <= steps; ++i) {
    const double angle = o.board_first + i * o.board_step;
    const double true_angle = angle + o.angle_error * random.Normal();
    boards_.push_back({.angle = angle,
                       .true_angle = true_angle,
                       .camera_from_board = rig().CameraFromDisk(true_angle * kDegree) * standing});
    Require(InImage(rig().camera, o.board, boards_.back().camera_from_board),
            "the board on the disk leaves the image; make 'board.square' smaller or the image larger");
  }
  constexpr int kTries = 1000;
  for (int i = 0; i < o.free_boards; ++i) {
    Eigen::Isometry3d pose = RandomBoardPose(o, rig().camera, random);
    int tries = 1;
    for (; tries < kTries && !InImage(rig().camera, o.board, pose); ++tries) {
      pose = RandomBoardPose(o, rig().camera, random);
    }
    Require(tries < kTries, "the board does not fit into the image; make 'board.square' smaller");
    boards_.push_back({.camera_from_board = pose});
  }
}

SyntheticView SyntheticTurntable::View(std::size_t index, int threads) const {
  const PlannedView& planned = views_.at(index);
  Random random = Random::ForKey(options_.seed, "turntable view " + std::to_string(index));
  return RenderView(scene_, options_.sensor, planned.exposure, planned.true_angle * kDegree, random, threads);
}

SyntheticBoardView SyntheticTurntable::BoardView(std::size_t index, int threads) const {
  const PlannedBoard& planned = boards_.at(index);
  Random random = Random::ForKey(options_.seed, "turntable board " + std::to_string(index));
  std::optional<double> angle;
  if (planned.true_angle) angle = *planned.true_angle * kDegree;
  return RenderBoard(scene_, options_.sensor, options_.board, planned.camera_from_board, angle, random,
                     threads);
}

SurfaceMesh SyntheticTurntable::TruthMesh(int rings, int around) const {
  SurfaceMesh mesh = scene_.pear.Mesh(rings, around);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex += scene_.pear_origin;
  return mesh;
}

std::map<std::string, double> SyntheticTurntable::TruthValues() const {
  const PinholeCamera& camera = rig().camera;
  return {{"axis_distance", rig().AxisDistance()},
          {"tilt", rig().Tilt() / kDegree},
          {"roll", rig().Roll() / kDegree},
          {"phi", options_.phi},
          {"fx", camera.focal[0]},
          {"fy", camera.focal[1]},
          {"cx", camera.focal[2]},
          {"cy", camera.focal[3]},
          {"k1", camera.distortion[0]},
          {"k2", camera.distortion[1]},
          {"p1", camera.distortion[2]},
          {"p2", camera.distortion[3]},
          {"k3", camera.distortion[4]},
          {"pear_x", scene_.pear_origin.x()},
          {"pear_y", scene_.pear_origin.y()},
          {"pear_z", scene_.pear_origin.z()},
          {"pear_height", options_.pear.height},
          {"pear_bend", options_.pear.bend},
          {"pear_flattening", options_.pear.flattening},
          {"pear_lobes", options_.pear.lobes},
          {"pear_area", scene_.pear.Area()},
          {"pear_volume", scene_.pear.Volume()}};
}

}  // namespace frond
