// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "problems/turntable/axis_calibration.h"
#include "solvers/fit_problem.h"

namespace frond {

// An axis in the camera's frame with the directions in which it can move: `point` is its foot from the
// camera's centre, across and along are orthogonal to it and each other and lie near the camera's x and z.
struct AxisFrame {
  Eigen::Vector3d point = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ();
};
AxisFrame MakeAxisFrame(const Eigen::Vector3d& point, const Eigen::Vector3d& up);

// What the fit starts from and comes to.
struct AxisState {
  PinholeCamera camera;
  AxisFrame frame;
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();  // the disk at 0 degrees
  std::vector<double> corrections = {};                                 // of each view's angle, radians
};

// The axis, the board on the disk, the angles and the camera from views of the board. Residuals, px: with the
// board's point in the camera's frame at 0 degrees q = MoveByPose(board, X), axis direction u ∝ up + a across
// + b along and point p = point + c across + d along,
//   π(camera; p + R(u, angle + correction) (q − p)) − pixel,
// one compressed block a view; and, with a prior, correction · corner_sigma / angle_sigma. Parameter blocks:
//   axis          4: a, b, c, d
//   board         6: see MoveByPose
//   focal         4, constant unless free_camera
//   distortion    5, constant unless free_camera
//   angle.0, …    1 each: correction, constant unless free_angles; the first always is
class AxisFit final : public FitProblem {
 public:
  // `views` must outlive this.
  AxisFit(const AxisState& start, const std::vector<AxisView>& views, const AxisOptions& options);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;

  AxisState StateAt(std::span<const double> x) const;

 private:
  AxisState start_;
  const std::vector<AxisView>& views_;
  bool has_prior_;
  double prior_weight_;  // px per radian
  std::vector<ParameterBlock> parameters_;
};

// Of the distances between projected and seen corners, px.
double AxisViewRms(const AxisState& state, const AxisView& view, double correction);
double AxisRms(const AxisState& state, const std::vector<AxisView>& views);

// The camera's frame from the disk's at 0 degrees turned by `angle`, for the axis of `frame`.
Eigen::Isometry3d TurnAbout(const AxisFrame& frame, double angle);

}  // namespace frond
