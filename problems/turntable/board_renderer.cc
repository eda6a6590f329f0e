// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "problems/turntable/turntable_light.h"

namespace frond {
namespace {

constexpr float kWhite = 255;
constexpr double kPaper = 0.85, kInk = 0.05, kBack = 0.3;  // albedos

// The mean over [x − w, x + w] of the wave that is +1 from an even to an odd number, −1 from an odd to an
// even one.
double MeanOfWave(double x, double w) {
  const auto integral = [](double at) { return 1 - std::abs(at - 2 * std::floor(at / 2) - 1); };
  return (integral(x + w) - integral(x - w)) / (2 * w);
}

// The light of a sheet with a chessboard, seen by one camera.
class SheetLight {
 public:
  // A sample stands for `sample` pixels in x and y.
  SheetLight(const TurntableScene& scene, const Board& board, const Eigen::Isometry3d& camera_from_board,
             double sample)
      : camera_(scene.rig.camera), board_(board), board_from_camera_(camera_from_board.inverse()) {
    const double towards = -camera_from_board.linear().col(2).dot(scene.lighting.ToLamp());
    front_ = scene.lighting.ambient + scene.lighting.diffuse * std::max(towards, 0.0);
    back_ = scene.lighting.ambient + scene.lighting.diffuse * std::max(-towards, 0.0);
    const Eigen::Vector2d middle =
        camera_.Project(camera_from_board * Eigen::Vector3d((board.columns - 1) / 2.0 * board.square,
                                                            (board.rows - 1) / 2.0 * board.square, 0));
    const Eigen::Vector2d along = (Place(middle + Eigen::Vector2d(1, 0)) - Place(middle)).cwiseAbs();
    const Eigen::Vector2d down = (Place(middle + Eigen::Vector2d(0, 1)) - Place(middle)).cwiseAbs();
    reach_ = 0.5 * sample * (along + down);
  }

  // None beside the sheet.
  std::optional<float> Seen(double u, double v) const {
    const Eigen::Vector2d place = Place({u, v});
    const double x = place.x(), y = place.y();
    const double outside = std::max(std::max(-1 - x, x - board_.columns), std::max(-1 - y, y - board_.rows));
    if (!(outside <= kBoardMargin)) return std::nullopt;
    if (board_from_camera_.translation().z() > 0) return kWhite * static_cast<float>(kBack * back_);
    if (outside > 0) return kWhite * static_cast<float>(kPaper * front_);
    // The mean of the pattern over the sample's place, so that edges lie where they are, not between samples.
    const double ink = (1 + MeanOfWave(x, reach_.x()) * MeanOfWave(y, reach_.y())) / 2;
    return kWhite * static_cast<float>((kPaper + ink * (kInk - kPaper)) * front_);
  }

 private:
  // On the board, in squares from the first inner corner; not a number where the pixel looks past its plane.
  Eigen::Vector2d Place(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d eye = board_from_camera_.translation();
    const Eigen::Vector3d direction = board_from_camera_.linear() * camera_.Ray(pixel);
    const double t = -eye.z() / direction.z();
    if (!(t > 0)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    return (eye + t * direction).head<2>() / board_.square;
  }

  const PinholeCamera& camera_;
  const Board& board_;
  Eigen::Isometry3d board_from_camera_;
  double front_ = 0, back_ = 0;                      // light on the sheet's sides
  Eigen::Vector2d reach_ = Eigen::Vector2d::Zero();  // half of a sample's size on the board, squares
};

}  // namespace

Eigen::Isometry3d StandingBoard(const TurntableScene& scene, const Board& board, double lean) {
  const double c = std::cos(lean), s = std::sin(lean);
  Eigen::Isometry3d disk_from_board = Eigen::Isometry3d::Identity();
  disk_from_board.linear().col(0) = Eigen::Vector3d(0, 1, 0);   // to the right, seen from the camera
  disk_from_board.linear().col(1) = Eigen::Vector3d(s, 0, -c);  // down
  disk_from_board.linear().col(2) = Eigen::Vector3d(-c, 0, -s);
  const double bottom = (board.rows + kBoardMargin) * board.square;  // of the sheet, in the board's frame
  const Eigen::Vector3d middle((board.columns - 1) / 2.0 * board.square,
                               (board.rows - 1) / 2.0 * board.square, 0);
  Eigen::Vector3d shift = -(disk_from_board.linear() * middle);
  shift.z() = scene.pear_origin.z() + bottom * c;
  disk_from_board.translation() = shift;
  return disk_from_board;
}

SyntheticBoardView RenderBoard(const TurntableScene& scene, const Sensor& sensor, const Board& board,
                               const Eigen::Isometry3d& camera_from_board, std::optional<double> angle,
                               Random& random, int threads) {
  if (board.kind != Board::Kind::kChessboard) {
    throw ConfigError("synthetic board: only a chessboard can be rendered; set 'board.kind: chessboard'");
  }
  const PinholeCamera& camera = scene.rig.camera;
  SyntheticBoardView view{.angle = angle, .camera_from_board = camera_from_board};
  for (const Eigen::Vector3d& p : BoardPoints(board)) {
    view.corners.push_back(camera.Project(camera_from_board * p));
  }
  const TurntableLight table(scene, angle.value_or(0), false, false);
  const SheetLight sheet(scene, board, camera_from_board, 1.0 / sensor.supersampling);
  const auto seen = [&](double u, double v) -> std::array<float, 3> {
    if (const auto grey = sheet.Seen(u, v)) return {*grey, *grey, *grey};
    return angle ? table.Seen(u, v) : table.Room();
  };
  Light film(camera.width, camera.height, table.Room());
  std::vector<Eigen::Vector3d> outline;  // distortion bends its edges: in short steps
  constexpr int kSteps = 20;
  const double left = -1 - kBoardMargin, right = board.columns + kBoardMargin,
               below = board.rows + kBoardMargin;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = left + (right - left) * i / kSteps, y = left + (below - left) * i / kSteps;
    for (const auto& [a, b] :
         {std::pair(x, left), std::pair(x, below), std::pair(left, y), std::pair(right, y)}) {
      outline.push_back(camera_from_board * Eigen::Vector3d(a * board.square, b * board.square, 0));
    }
  }
  const PixelBox box = BoxAround(camera, outline, 3);
  Collect(box, {}, sensor.supersampling, threads, seen, &film);
  if (angle) Collect(table.DiskBox(), box, sensor.supersampling, threads, seen, &film);
  Sensor grey = sensor;
  grey.colour = false;
  view.image = Develop(std::move(film), grey, {}, random).image;
  return view;
}

}  // namespace frond
