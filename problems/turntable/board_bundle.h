// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "models/pinhole_camera.h"
#include "problems/turntable/board.h"
#include "solvers/fit_problem.h"

namespace frond {

// One position of the board. Either camera's corners may be empty (or all of the second's, for one camera).
struct BundleView {
  std::array<BoardCorners, 2> corners = {};
  Eigen::Isometry3d first_from_board = Eigen::Isometry3d::Identity();
};

struct BundleOptions {
  bool square_pixels = false;         // fx = fy of each camera
  bool centred = false;               // the principal points held
  bool tangential_distortion = true;  // p1, p2; else held
  int radial_distortion = 3;          // how many of k1, k2, k3; the others held
  bool same_focal_length = false;     // of both cameras
  double robust_width = 0;            // px: of a Huber loss on each corner's distance; 0: none
};

// Cameras and board poses together. Residuals: projected corner − seen corner, px, compressed to one block a
// view and camera. Parameter blocks, of one camera or two:
//   first.length, second.length          2: fx, fy/fx (second's absent: same_focal_length)
//   first.centre, second.centre          2: cx, cy
//   first.distortion, second.distortion  5
//   pose                                 6: second_from_first, see MoveByPose; only of two cameras
//   board0, board1, …                    6 each: first_from_board
class BoardBundle final : public FitProblem {
 public:
  // `views` must outlive this.
  BoardBundle(const PinholeCamera& first, const std::vector<BundleView>& views, const BundleOptions& options);
  BoardBundle(const PinholeCamera& first, const PinholeCamera& second,
              const Eigen::Isometry3d& second_from_first, const std::vector<BundleView>& views,
              const BundleOptions& options);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;

  int cameras() const { return cameras_; }
  PinholeCamera CameraAt(std::span<const double> x, int camera) const;
  Eigen::Isometry3d PoseAt(std::span<const double> x) const;             // second_from_first
  Eigen::Isometry3d BoardAt(std::span<const double> x, int view) const;  // first_from_board

  // Standard deviations of fx, fy, cx, cy, k1, k2, p1, p2, k3 by the covariance of x.
  std::array<double, 9> CameraSigma(std::span<const double> x, const Eigen::MatrixXd& covariance,
                                    int camera) const;
  std::array<double, 6> PoseSigma(const Eigen::MatrixXd& covariance) const;

  // Of the distances between projected and seen corners, px: in one view and camera (0: none seen), in all.
  double ViewRms(std::span<const double> x, int view, int camera) const;
  double Rms(std::span<const double> x) const;

  // σ² of a coordinate of a corner: the sum of squares over coordinates − free parameters (tangent).
  double CornerVariance(std::span<const double> x) const;

 private:
  struct Offsets {  // of a parameter block: in parameters() and in x
    std::size_t block = 0;
    std::size_t value = 0;
  };

  void AddCamera(const PinholeCamera& camera, int index, const BundleOptions& options);
  Offsets Append(ParameterBlock block);
  double SumOfSquares(std::span<const double> x, int view, int camera) const;
  std::size_t NumCorners() const;

  const std::vector<BundleView>& views_;
  int cameras_ = 1;
  double robust_width_ = 0;
  std::array<PinholeCamera, 2> start_;
  Eigen::Matrix3d pose_rotation_ = Eigen::Matrix3d::Identity();
  std::vector<ParameterBlock> parameters_;
  std::size_t num_values_ = 0;
  std::array<Offsets, 2> length_, centre_, distortion_;
  Offsets pose_, first_board_;
};

}  // namespace frond
