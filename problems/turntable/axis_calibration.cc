// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/axis_calibration.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "base/errors.h"
#include "problems/turntable/axis_fit.h"
#include "problems/turntable/axis_start.h"
#include "problems/turntable/rig_warnings.h"
#include "solvers/parameter_covariance.h"

namespace frond {
namespace {

constexpr std::size_t kFewestAngles = 3;
constexpr std::size_t kFewestViewsToFreeAngles = 4;
constexpr double kClearlyWorse = 2;      // of two RMS
constexpr double kLooksAlongAxis = 0.1;  // of the axis's y in the camera's frame: up and down are alike
constexpr int kAxisValues = 4, kBoardValues = 6, kCameraValues = 9;

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void CheckViews(const std::vector<AxisView>& views) {
  std::vector<double> distinct;
  for (const AxisView& view : views) {
    if (!std::isfinite(view.angle)) throw InputError(view.name + ": its angle is not a number");
    const bool seen = std::any_of(distinct.begin(), distinct.end(), [&](double angle) {
      return std::abs(std::remainder(angle - view.angle, 2 * std::numbers::pi)) < 1e-6;
    });
    if (!seen) distinct.push_back(view.angle);
  }
  if (distinct.size() >= kFewestAngles) return;
  throw InputError("the board is seen at " + std::to_string(distinct.size()) +
                   " table angle(s), the axis needs at least 3: add views, 10 and more are recommended");
}

struct Fitted {
  AxisState state;
  SolverReport report;
  double rms = std::numeric_limits<double>::infinity();
};

Fitted RunFit(const AxisState& start, const std::vector<AxisView>& views, const AxisOptions& options) {
  const AxisFit fit(start, views, options);
  const SolverType& lm = FindSolverType("lm");
  Fitted fitted{.state = start,
                .report = lm.create(Options(lm.options))->Solve(fit, {}, {.threads = options.threads})};
  if (fitted.report.termination == Termination::kFailed) return fitted;
  fitted.state = fit.StateAt(fitted.report.x);
  fitted.rms = AxisRms(fitted.state, views);
  return fitted;
}

std::vector<AxisView> Negated(std::vector<AxisView> views) {
  for (AxisView& view : views) view.angle = -view.angle;
  return views;
}

// The fit with the angles held. The axis points up, so that the sense of turning shows in the residuals.
Fitted FitBothSenses(const PinholeCamera& camera, const std::vector<AxisView>& views,
                     const std::vector<Eigen::Isometry3d>& poses, int threads, double* reversed_rms,
                     std::vector<std::string>* warnings) {
  Eigen::Vector3d up = TurnDirection(views, poses);
  if (up.y() > 0) up = -up;
  const AxisOptions held{.threads = threads};
  Fitted given = RunFit(AxisStart(camera, views, poses, up), views, held);
  const std::vector<AxisView> negated = Negated(views);
  const Fitted reversed = RunFit(AxisStart(camera, negated, poses, up), negated, held);
  *reversed_rms = reversed.rms;
  const std::string figures = "corners are off by " + Number(given.rms) + " px with the angles given, by " +
                              Number(reversed.rms) + " px with all of them negated";
  if (given.rms > kClearlyWorse * reversed.rms && std::abs(up.y()) > kLooksAlongAxis) {
    throw InputError("the table turns the other way: " + figures +
                     ": negate the angles (they count counter-clockwise seen from above)");
  }
  if (!(reversed.rms > kClearlyWorse * given.rms)) {
    warnings->push_back("the sense of the table's angles cannot be told: " + figures +
                        ": turn the board farther");
  }
  if (!std::isfinite(given.rms)) {
    throw FitError("the axis cannot be fitted: " + given.report.message +
                   ": check the views' angles, the board's size and the camera");
  }
  return given;
}

// Values of d, tilt and roll over (a, b, c, d) of AxisFit.
template <typename T>
void DeriveFromAxis(const AxisFrame& frame, const T* axis, T* distance, T* tilt, T* roll) {
  using std::atan2, std::sqrt;
  T up[3], point[3], norm2 = T(0), dot = T(0), foot2 = T(0);
  for (int j = 0; j < 3; ++j) {
    up[j] = frame.up[j] + axis[0] * frame.across[j] + axis[1] * frame.along[j];
    point[j] = frame.point[j] + axis[2] * frame.across[j] + axis[3] * frame.along[j];
    norm2 += up[j] * up[j];
    dot += up[j] * point[j];
    foot2 += point[j] * point[j];
  }
  *distance = sqrt(foot2 - dot * dot / norm2);
  *tilt = atan2(-up[2], sqrt(up[0] * up[0] + up[1] * up[1]));
  *roll = atan2(up[0], -up[1]);
}

Estimate EstimateOf(const ceres::Jet<double, kAxisValues>& value, const Eigen::MatrixXd& covariance) {
  const Eigen::Matrix4d of_axis = covariance.topLeftCorner<kAxisValues, kAxisValues>();
  return {value.a, std::sqrt(value.v.dot(of_axis * value.v))};
}

void Derive(const AxisFrame& frame, AxisCalibration* calibration) {
  using Jet = ceres::Jet<double, kAxisValues>;
  Jet axis[kAxisValues], distance, tilt, roll;
  for (int k = 0; k < kAxisValues; ++k) axis[k] = Jet(0, k);
  DeriveFromAxis(frame, axis, &distance, &tilt, &roll);
  calibration->distance = EstimateOf(distance, calibration->covariance);
  calibration->tilt = EstimateOf(tilt, calibration->covariance);
  calibration->roll = EstimateOf(roll, calibration->covariance);
}

// σ² of a coordinate of a corner.
double CornerVariance(const AxisFit& fit, const AxisState& state, const std::vector<AxisView>& views,
                      const AxisOptions& options) {
  double corners = 0, priors = 0, prior_squares = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    corners += static_cast<double>(views[k].corners.pixels.size());
    if (k == 0 || !options.free_angles || !(options.angle_sigma > 0)) continue;
    priors += 1;
    prior_squares += std::pow(state.corrections[k] * options.corner_sigma / options.angle_sigma, 2);
  }
  const double rms = AxisRms(state, views);
  const double free = 2 * corners + priors - fit.NumFreeParameters();
  return (rms * rms * corners + prior_squares) / std::max(1.0, free);
}

// Names, values and covariance of the free parameters, the axis first.
void FillParameters(const AxisState& state, const std::vector<AxisView>& views, const AxisOptions& options,
                    AxisCalibration* calibration) {
  const AxisFit fit(state, views, options);
  const std::vector<double> x = fit.StartVector();
  const double variance = CornerVariance(fit, state, views, options);
  calibration->corner_sigma = std::sqrt(variance);
  const Eigen::MatrixXd all = variance * UnitCovariance(fit, x);

  std::vector<std::string> names = {
      "axis.direction_x", "axis.direction_z", "axis.point_x",     "axis.point_z",     "board.rotation_x",
      "board.rotation_y", "board.rotation_z", "board.position_x", "board.position_y", "board.position_z"};
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < kAxisValues + kBoardValues; ++k) kept.push_back(k);
  if (options.free_camera) {
    for (const char* name : {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"}) {
      kept.push_back(static_cast<Eigen::Index>(names.size()));
      names.push_back(std::string("camera.") + name);
    }
  }
  calibration->angle_parameter.assign(views.size(), -1);
  for (std::size_t k = 1; k < views.size() && options.free_angles; ++k) {
    kept.push_back(static_cast<Eigen::Index>(k) + kAxisValues + kBoardValues + kCameraValues);
    calibration->angle_parameter[k] = static_cast<int>(names.size());
    names.push_back("angle." + views[k].name);
  }
  calibration->parameter_names = std::move(names);
  calibration->covariance = all(kept, kept);
  calibration->parameters =
      Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))(kept);
}

void FillErrorsOfAngles(const AxisState& start, const std::vector<AxisView>& views, int threads,
                        AxisCalibration* calibration) {
  if (views.size() < kFewestViewsToFreeAngles) return;
  const AxisOptions free{.free_angles = true, .threads = threads};
  const Fitted fitted = RunFit(start, views, free);
  AxisCalibration with_free_angles;
  FillParameters(fitted.state, views, free, &with_free_angles);
  calibration->free_angles_rms = fitted.rms;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const int at = with_free_angles.angle_parameter[k];
    calibration->angle_errors.push_back(
        {fitted.state.corrections[k], at < 0 ? 0 : std::sqrt(with_free_angles.covariance(at, at))});
  }
}

}  // namespace

AxisCalibration CalibrateAxis(const PinholeCamera& camera, const std::vector<AxisView>& given_views,
                              const AxisOptions& options) {
  CheckViews(given_views);
  std::vector<AxisView> views = given_views;
  const std::vector<Eigen::Isometry3d> poses = LocateBoards(camera, &views);
  AxisCalibration calibration;
  const Fitted held =
      FitBothSenses(camera, views, poses, options.threads, &calibration.reversed_rms, &calibration.warnings);
  FillErrorsOfAngles(held.state, views, options.threads, &calibration);

  // Again from the solution: the parameters are then small steps from it, and so is their covariance.
  Fitted fitted = RunFit(RunFit(held.state, views, options).state, views, options);
  if (!std::isfinite(fitted.rms)) throw FitError("the axis cannot be fitted: " + fitted.report.message);
  FillParameters(fitted.state, views, options, &calibration);
  Derive(fitted.state.frame, &calibration);
  calibration.report = fitted.report;
  calibration.rms = fitted.rms;
  calibration.rig = RigFromAxis(fitted.state.camera, fitted.state.frame.point, fitted.state.frame.up);
  calibration.disk_from_board = calibration.rig.camera_from_disk.inverse() * fitted.state.camera_from_board;
  for (std::size_t k = 0; k < views.size(); ++k) {
    calibration.angles.push_back(views[k].angle + fitted.state.corrections[k]);
    calibration.view_rms.push_back(AxisViewRms(fitted.state, views[k], fitted.state.corrections[k]));
  }
  for (std::string& warning : RigWarnings(calibration, views)) {
    calibration.warnings.push_back(std::move(warning));
  }
  calibration.notes = RigNotes(calibration);
  return calibration;
}

Estimate TurnBetween(const AxisCalibration& calibration, int first, int second) {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
  const int a = calibration.angle_parameter[i], b = calibration.angle_parameter[j];
  const auto covariance = [&](int p, int q) { return p < 0 || q < 0 ? 0 : calibration.covariance(p, q); };
  return {calibration.angles[j] - calibration.angles[i],
          std::sqrt(std::max(0.0, covariance(a, a) + covariance(b, b) - 2 * covariance(a, b)))};
}

}  // namespace frond
