// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/stereo_calibration.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/errors.h"
#include "base/median.h"
#include "problems/turntable/board_bundle.h"
#include "problems/turntable/intrinsics.h"
#include "solvers/parameter_covariance.h"

namespace frond {
namespace {

constexpr double kBadView = 3;       // of the median view's RMS
constexpr double kBadViewRms = 0.3;  // px, less is never bad

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

PinholeCamera CameraOf(const std::vector<BoardPair>& pairs, bool left, int width, int height,
                       const StereoCalibrationOptions& options, std::vector<Eigen::Isometry3d>* poses) {
  std::vector<BoardCorners> views;
  std::vector<std::string> names;
  for (const BoardPair& pair : pairs) {
    views.push_back(left ? pair.left : pair.right);
    names.push_back(pair.name + (left ? " (left)" : " (right)"));
  }
  IntrinsicsCalibration found = CalibrateIntrinsics(views, names, width, height,
                                                    {.square_pixels = options.square_pixels,
                                                     .tangential_distortion = options.tangential_distortion,
                                                     .radial_distortion = options.radial_distortion});
  *poses = std::move(found.camera_from_board);
  return found.camera;
}

// Each pair of board poses gives one relative pose. The start is the component-wise median of them.
Eigen::Isometry3d MedianPose(const std::vector<Eigen::Isometry3d>& poses) {
  Eigen::Matrix<double, 3, 4> median;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      std::vector<double> values;
      for (const Eigen::Isometry3d& pose : poses) values.push_back(pose.matrix()(i, j));
      median(i, j) = Median(values);
    }
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(median.leftCols<3>(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();  // the nearest rotation
  pose.translation() = median.col(3);
  return pose;
}

// A board that may be upside down is read in the right image as it is in the left: the two ways differ by
// half a turn in the relative pose, and the reading that agrees with the other pairs is taken.
void MatchEnds(const PinholeCamera& right, const std::vector<Eigen::Isometry3d>& left_poses,
               std::vector<BoardPair>* pairs, std::vector<Eigen::Isometry3d>* right_poses) {
  std::vector<Eigen::Isometry3d> turned_poses;
  for (const BoardPair& pair : *pairs) {
    if (!pair.right.may_be_upside_down) return;
    turned_poses.push_back(LocateBoard(right, TurnedUpsideDown(pair.right), pair.name));
  }
  for (std::size_t k = 0; k < pairs->size(); ++k) {
    const auto turn = [&](const Eigen::Isometry3d& pose) {
      return Eigen::AngleAxisd(pose.linear() * left_poses[k].linear().transpose()).angle();
    };
    // The cameras of a pair look the same way up.
    if (turn(turned_poses[k]) < turn((*right_poses)[k])) {
      (*pairs)[k].right = TurnedUpsideDown((*pairs)[k].right);
      (*right_poses)[k] = turned_poses[k];
    }
  }
}

std::vector<std::string> Warnings(const StereoCalibration& calibration, const std::vector<BoardPair>& pairs) {
  std::vector<double> all;
  for (const auto& rms : calibration.view_rms) all.insert(all.end(), rms.begin(), rms.end());
  const double median = Median(all);
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (std::size_t c = 0; c < 2; ++c) {
      const double rms = calibration.view_rms[k][c];
      if (rms < std::max(kBadViewRms, kBadView * median)) continue;
      warnings.push_back(pairs[k].name + (c == 0 ? " (left)" : " (right)") + ": its corners are off by " +
                         Number(rms) + " px, those of the median view by " + Number(median) +
                         " px: a blurred or moved image?");
    }
  }
  return warnings;
}

StereoCalibration Fit(const BoardBundle& bundle, int threads) {
  const SolverType& lm = FindSolverType("lm");
  StereoCalibration calibration;
  calibration.report = lm.create(Options(lm.options))->Solve(bundle, {}, {.threads = threads});
  if (calibration.report.termination == Termination::kFailed) {
    throw FitError("the stereo pair cannot be fitted: " + calibration.report.message +
                   ": check that both images of each pair show the same board");
  }
  return calibration;
}

}  // namespace

StereoCalibration CalibrateStereo(const std::vector<BoardPair>& given_pairs, int width, int height,
                                  const StereoCalibrationOptions& options) {
  std::vector<BoardPair> pairs = given_pairs;
  std::vector<Eigen::Isometry3d> left_poses, right_poses;
  const PinholeCamera left = CameraOf(pairs, true, width, height, options, &left_poses);
  const PinholeCamera right = CameraOf(pairs, false, width, height, options, &right_poses);
  MatchEnds(right, left_poses, &pairs, &right_poses);
  std::vector<BundleView> views;
  std::vector<Eigen::Isometry3d> relative;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    views.push_back({.corners = {pairs[k].left, pairs[k].right}, .first_from_board = left_poses[k]});
    relative.push_back(right_poses[k] * left_poses[k].inverse());
  }
  const BundleOptions bundle_options{.square_pixels = options.square_pixels,
                                     .tangential_distortion = options.tangential_distortion,
                                     .radial_distortion = options.radial_distortion,
                                     .same_focal_length = options.same_focal_length,
                                     .robust_width = options.robust_width};
  const BoardBundle bundle(left, right, MedianPose(relative), views, bundle_options);
  StereoCalibration calibration = Fit(bundle, options.threads);
  const std::vector<double>& x = calibration.report.x;
  calibration.pair = {
      .left = bundle.CameraAt(x, 0), .right = bundle.CameraAt(x, 1), .right_from_left = bundle.PoseAt(x)};
  calibration.rms = bundle.Rms(x);
  for (int k = 0; k < static_cast<int>(views.size()); ++k) {
    calibration.view_rms.push_back({bundle.ViewRms(x, k, 0), bundle.ViewRms(x, k, 1)});
  }
  const Eigen::MatrixXd covariance = bundle.CornerVariance(x) * UnitCovariance(bundle, x);
  calibration.left_sigma = bundle.CameraSigma(x, covariance, 0);
  calibration.right_sigma = bundle.CameraSigma(x, covariance, 1);
  calibration.pose_sigma = bundle.PoseSigma(covariance);
  calibration.warnings = Warnings(calibration, pairs);
  return calibration;
}

}  // namespace frond
