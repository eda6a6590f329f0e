// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/intrinsics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "base/errors.h"
#include "base/median.h"
#include "problems/turntable/board_bundle.h"
#include "problems/turntable/opencv_corners.h"
#include "solvers/parameter_covariance.h"

namespace frond {
namespace {

constexpr std::size_t kFewestViews = 3;
constexpr std::size_t kEnoughViews = 8;
constexpr std::size_t kFewestCorners = 4;
constexpr double kSmallestTilt = 5 * std::numbers::pi / 180;  // between the normals of two boards
constexpr double kBadView = 3;                                // of the median view's RMS
constexpr double kBadViewRms = 0.3;                           // px, less is never bad

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void CheckViews(const std::vector<BoardCorners>& views, const std::vector<std::string>& names) {
  if (views.size() < kFewestViews) {
    throw InputError("a board is found in " + std::to_string(views.size()) +
                     " image(s), the camera needs at least 3 views of it at different tilts");
  }
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].pixels.size() >= kFewestCorners) continue;
    throw InputError(names[k] + ": only " + std::to_string(views[k].pixels.size()) +
                     " corners of the board are seen, at least 4 are needed: leave the image out");
  }
}

int Flags(const IntrinsicsOptions& options) {
  int flags = 0;
  if (options.square_pixels) flags |= cv::CALIB_FIX_ASPECT_RATIO;
  if (options.centred) flags |= cv::CALIB_FIX_PRINCIPAL_POINT;
  if (!options.tangential_distortion) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  if (options.radial_distortion < 1) flags |= cv::CALIB_FIX_K1;
  if (options.radial_distortion < 2) flags |= cv::CALIB_FIX_K2;
  if (options.radial_distortion < 3) flags |= cv::CALIB_FIX_K3;
  return flags;
}

// Zhang's equations need planes of different orientation: parallel ones give nothing new.
void CheckTilts(const std::vector<Eigen::Isometry3d>& poses) {
  double widest = 0;
  for (const Eigen::Isometry3d& a : poses) {
    for (const Eigen::Isometry3d& b : poses) {
      widest = std::max(widest, std::acos(std::clamp(a.linear().col(2).dot(b.linear().col(2)), -1.0, 1.0)));
    }
  }
  if (widest >= kSmallestTilt) return;
  throw InputError("the board stands at the same tilt in all " + std::to_string(poses.size()) +
                   " views (within " + Number(widest * 180 / std::numbers::pi) +
                   " degrees): add views of it tilted by 20 degrees and more");
}

void CheckCamera(const PinholeCamera& camera) {
  const double size = std::max(camera.width, camera.height);
  bool finite = true;
  for (const double value : camera.focal) finite = finite && std::isfinite(value);
  for (const double value : camera.distortion) finite = finite && std::isfinite(value);
  if (finite && camera.focal[0] > 0.1 * size && camera.focal[0] < 100 * size) return;
  throw InputError("the views give no camera (focal length " + Number(camera.focal[0]) +
                   " px): add views of the board at other tilts and all over the image");
}

std::vector<std::string> Warnings(const IntrinsicsCalibration& calibration,
                                  const std::vector<std::string>& names) {
  std::vector<std::string> warnings;
  if (names.size() < kEnoughViews) {
    warnings.push_back("the camera is calibrated from " + std::to_string(names.size()) +
                       " views only: 8 and more are recommended");
  }
  const double median = Median(calibration.view_rms);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (calibration.view_rms[k] < std::max(kBadViewRms, kBadView * median)) continue;
    warnings.push_back(names[k] + ": its corners are off by " + Number(calibration.view_rms[k]) +
                       " px, those of the median view by " + Number(median) +
                       " px: a blurred or moved image?");
  }
  return warnings;
}

// OpenCV 4.6's own deviations divide by corners, not coordinates, and come out too large (its issue 19803).
void Complete(const std::vector<BoardCorners>& views, const IntrinsicsOptions& options,
              IntrinsicsCalibration* calibration) {
  std::vector<BundleView> bundle_views;
  for (std::size_t k = 0; k < views.size(); ++k) {
    bundle_views.push_back(
        {.corners = {views[k], {}}, .first_from_board = calibration->camera_from_board[k]});
  }
  const BoardBundle bundle(calibration->camera, bundle_views,
                           {.square_pixels = options.square_pixels,
                            .centred = options.centred,
                            .tangential_distortion = options.tangential_distortion,
                            .radial_distortion = options.radial_distortion});
  const std::vector<double> x = bundle.StartVector();
  calibration->rms = bundle.Rms(x);
  for (int k = 0; k < static_cast<int>(views.size()); ++k) {
    calibration->view_rms.push_back(bundle.ViewRms(x, k, 0));
  }
  const Eigen::MatrixXd covariance = bundle.CornerVariance(x) * UnitCovariance(bundle, x);
  const std::array<double, 9> sigma = bundle.CameraSigma(x, covariance, 0);
  std::copy_n(sigma.begin(), 4, calibration->focal_sigma.begin());
  std::copy_n(sigma.begin() + 4, 5, calibration->distortion_sigma.begin());
}

}  // namespace

IntrinsicsCalibration CalibrateIntrinsics(const std::vector<BoardCorners>& views,
                                          const std::vector<std::string>& names, int width, int height,
                                          const IntrinsicsOptions& options) {
  CheckViews(views, names);
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardCorners& view : views) {
    points.emplace_back();
    pixels.emplace_back();
    for (const cv::Point3d& p : OpencvPoints(view)) points.back().emplace_back(p);
    for (const cv::Point2d& p : OpencvPixels(view)) pixels.back().emplace_back(p);
  }
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F), distortion = cv::Mat::zeros(1, 5, CV_64F);
  std::vector<cv::Mat> rotations, translations;
  try {
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-14);
    cv::calibrateCamera(points, pixels, {width, height}, matrix, distortion, rotations, translations,
                        Flags(options), until);
  } catch (const cv::Exception&) {
    throw InputError(
        "the views give no camera: add views of the board at other tilts and all over the image");
  }
  IntrinsicsCalibration calibration;
  calibration.camera.width = width;
  calibration.camera.height = height;
  calibration.camera.focal = {matrix.at<double>(0, 0), matrix.at<double>(1, 1), matrix.at<double>(0, 2),
                              matrix.at<double>(1, 2)};
  for (int k = 0; k < 5; ++k)
    calibration.camera.distortion[static_cast<std::size_t>(k)] = distortion.at<double>(k);
  CheckCamera(calibration.camera);
  for (std::size_t k = 0; k < views.size(); ++k) {
    calibration.camera_from_board.push_back(PoseFromOpencv(rotations[k], translations[k]));
  }
  CheckTilts(calibration.camera_from_board);
  try {
    Complete(views, options, &calibration);
  } catch (const FitError&) {
    throw InputError("the views do not determine the camera: add views of the board at other tilts");
  }
  calibration.warnings = Warnings(calibration, names);
  return calibration;
}

Eigen::Isometry3d LocateBoard(const PinholeCamera& camera, const BoardCorners& corners,
                              const std::string& name) {
  const std::string failure = name + ": the board cannot be located from its " +
                              std::to_string(corners.pixels.size()) + " corners: leave the image out";
  if (corners.pixels.size() < kFewestCorners) throw InputError(failure);
  cv::Mat rotation, translation;
  try {
    const cv::Mat matrix = OpencvMatrix(camera), distortion = OpencvDistortion(camera);
    const std::vector<cv::Point3d> points = OpencvPoints(corners);
    const std::vector<cv::Point2d> pixels = OpencvPixels(corners);
    if (!cv::solvePnP(points, pixels, matrix, distortion, rotation, translation, false, cv::SOLVEPNP_IPPE)) {
      throw InputError(failure);
    }
    cv::solvePnPRefineLM(points, pixels, matrix, distortion, rotation, translation);
  } catch (const cv::Exception&) {
    throw InputError(failure);
  }
  const Eigen::Isometry3d pose = PoseFromOpencv(rotation, translation);
  if (!pose.matrix().allFinite() || !(pose.translation().z() > 0)) throw InputError(failure);
  return pose;
}

}  // namespace frond
