// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/axis_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <cmath>
#include <string>

#include "problems/turntable/pose_step.h"
#include "solvers/compressed_cost_function.h"

namespace frond {
namespace {

constexpr double kLooksAlongAxis = 0.9;  // cosine between the axis and the viewing direction

// Residual i of AxisFit, over blocks axis, board, focal, distortion, correction.
struct TurnedBoardResidual {
  const BoardCorners* corners;
  double angle;
  AxisFrame frame;
  Eigen::Matrix3d board_rotation;

  template <typename T>
  bool operator()(int i, const T* axis, const T* board, const T* focal, const T* distortion,
                  const T* correction, T* residual) const {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector3d& X = corners->points[k];
    const T on_board[3] = {T(X.x()), T(X.y()), T(X.z())};
    T q[3], point[3], turn[3], norm2 = T(0);
    MoveByPose(board_rotation, board, on_board, q);
    for (int j = 0; j < 3; ++j) {
      turn[j] = frame.up[j] + axis[0] * frame.across[j] + axis[1] * frame.along[j];
      norm2 += turn[j] * turn[j];
      point[j] = frame.point[j] + axis[2] * frame.across[j] + axis[3] * frame.along[j];
      q[j] -= point[j];
    }
    using std::sqrt;
    const T scale = (T(angle) + correction[0]) / sqrt(norm2);
    for (T& value : turn) value *= scale;
    T turned[3];
    ceres::AngleAxisRotatePoint(turn, q, turned);
    for (int j = 0; j < 3; ++j) turned[j] += point[j];
    if (!(turned[2] > T(0))) return false;
    ProjectPinhole(focal, distortion, turned, residual);
    residual[0] -= T(corners->pixels[k].x());
    residual[1] -= T(corners->pixels[k].y());
    return true;
  }
};

// correction · weight.
struct AnglePrior {
  double weight;

  template <typename T>
  bool operator()(const T* correction, T* residual) const {
    residual[0] = weight * correction[0];
    return true;
  }
};

enum Block : std::size_t { kAxis, kBoard, kFocal, kDistortion, kFirstAngle };
constexpr std::size_t kFirstAngleValue = 4 + 6 + 4 + 5;

}  // namespace

AxisFrame MakeAxisFrame(const Eigen::Vector3d& point, const Eigen::Vector3d& up) {
  AxisFrame frame;
  frame.up = up.normalized();
  frame.point = point - point.dot(frame.up) * frame.up;
  if (std::abs(frame.up.z()) < kLooksAlongAxis) {
    frame.along = (Eigen::Vector3d::UnitZ() - frame.up.z() * frame.up).normalized();
    frame.across = frame.along.cross(frame.up);
  } else {
    frame.across = (Eigen::Vector3d::UnitX() - frame.up.x() * frame.up).normalized();
    frame.along = frame.up.cross(frame.across);
  }
  return frame;
}

AxisFit::AxisFit(const AxisState& start, const std::vector<AxisView>& views, const AxisOptions& options)
    : start_(start),
      views_(views),
      has_prior_(options.free_angles && options.angle_sigma > 0),
      prior_weight_(has_prior_ ? options.corner_sigma / options.angle_sigma : 0) {
  const std::array<double, 6> board = PoseStart(start.camera_from_board);
  const auto& [width, height, focal, distortion] = start.camera;
  parameters_ = {
      {.name = "axis", .start = {0, 0, 0, 0}},
      {.name = "board", .start = {board.begin(), board.end()}},
      {.name = "focal", .start = {focal.begin(), focal.end()}, .constant = !options.free_camera},
      {.name = "distortion",
       .start = {distortion.begin(), distortion.end()},
       .constant = !options.free_camera},
  };
  for (std::size_t k = 0; k < views.size(); ++k) {
    parameters_.push_back({.name = "angle." + std::to_string(k),
                           .start = {start.corrections[k]},
                           .constant = k == 0 || !options.free_angles});
  }
}

void AxisFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                           ceres::Problem* problem) const {
  using Cost = CompressedAutoDiffCostFunction<TurnedBoardResidual, 2, 4, 6, 4, 5, 1>;
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const AxisView& view = views_[k];
    const TurnedBoardResidual functor{&view.corners, view.angle, start_.frame,
                                      start_.camera_from_board.linear()};
    double* const correction = blocks[kFirstAngle + k];
    problem->AddResidualBlock(new Cost(functor, static_cast<int>(view.corners.pixels.size())), nullptr,
                              blocks[kAxis], blocks[kBoard], blocks[kFocal], blocks[kDistortion], correction);
    if (has_prior_ && k > 0) {
      problem->AddResidualBlock(
          new ceres::AutoDiffCostFunction<AnglePrior, 1, 1>(new AnglePrior{prior_weight_}), nullptr,
          correction);
    }
  }
}

AxisState AxisFit::StateAt(std::span<const double> x) const {
  AxisState state = start_;
  const AxisFrame& frame = start_.frame;
  state.frame = MakeAxisFrame(frame.point + x[2] * frame.across + x[3] * frame.along,
                              frame.up + x[0] * frame.across + x[1] * frame.along);
  state.camera_from_board = PoseOf(start_.camera_from_board.linear(), &x[4]);
  std::copy_n(&x[10], 4, state.camera.focal.begin());
  std::copy_n(&x[14], 5, state.camera.distortion.begin());
  std::copy_n(&x[kFirstAngleValue], views_.size(), state.corrections.begin());
  return state;
}

Eigen::Isometry3d TurnAbout(const AxisFrame& frame, double angle) {
  return Eigen::Translation3d(frame.point) * Eigen::AngleAxisd(angle, frame.up) *
         Eigen::Translation3d(-frame.point);
}

namespace {

double SumOfSquares(const AxisState& state, const AxisView& view, double correction) {
  const Eigen::Isometry3d pose = TurnAbout(state.frame, view.angle + correction) * state.camera_from_board;
  double sum = 0;
  for (std::size_t i = 0; i < view.corners.pixels.size(); ++i) {
    sum += (state.camera.Project(pose * view.corners.points[i]) - view.corners.pixels[i]).squaredNorm();
  }
  return sum;
}

}  // namespace

double AxisViewRms(const AxisState& state, const AxisView& view, double correction) {
  return std::sqrt(SumOfSquares(state, view, correction) / static_cast<double>(view.corners.pixels.size()));
}

double AxisRms(const AxisState& state, const std::vector<AxisView>& views) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    sum += SumOfSquares(state, views[k], state.corrections[k]);
    count += static_cast<double>(views[k].corners.pixels.size());
  }
  return std::sqrt(sum / count);
}

}  // namespace frond
