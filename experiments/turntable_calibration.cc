// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/turntable_calibration.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "experiments/board_views.h"
#include "experiments/named_errors.h"
#include "problems/turntable/axis_calibration.h"
#include "problems/turntable/intrinsics.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void SetEstimate(const std::string& name, const Estimate& estimate, double unit, MetricTable* metrics) {
  metrics->Set(name, estimate.value / unit);
  metrics->Set(name + "_sigma", estimate.sigma / unit);
}

void AddWarnings(const std::vector<std::string>& warnings, FitOutcome* outcome) {
  outcome->warnings.insert(outcome->warnings.end(), warnings.begin(), warnings.end());
}

PinholeCamera CameraOf(const BoardViews& boards, const Options& problem, FitOutcome* outcome) {
  std::vector<BoardCorners> corners;
  std::vector<std::string> names;
  for (const BoardView& view : boards.views) {
    corners.push_back(view.corners);
    names.push_back(view.name);
  }
  const IntrinsicsOptions options{.square_pixels = problem.Flag("calibration.square_pixels"),
                                  .centred = problem.Flag("calibration.centred"),
                                  .tangential_distortion = problem.Flag("calibration.tangential_distortion"),
                                  .radial_distortion = problem.Integer("calibration.radial_distortion")};
  const IntrinsicsCalibration found =
      CalibrateIntrinsics(corners, names, boards.width, boards.height, options);
  AddWarnings(found.warnings, outcome);
  outcome->metrics.Set("intrinsics_rms", found.rms);
  return found.camera;
}

void CheckCamera(const PinholeCamera& camera, const BoardViews& boards) {
  if (camera.width == boards.width && camera.height == boards.height) return;
  throw InputError(boards.views[0].name + ": is " + std::to_string(boards.width) + " x " +
                   std::to_string(boards.height) + " pixels, but the camera was calibrated at " +
                   std::to_string(camera.width) + " x " + std::to_string(camera.height));
}

CalibrationRecord RecordOf(const AxisCalibration& axis, const std::string& unit) {
  CalibrationRecord record{.unit = unit, .rms = axis.rms, .parameters = {}, .covariance = {}};
  const auto count = static_cast<Eigen::Index>(axis.parameter_names.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    record.parameters.push_back({axis.parameter_names[static_cast<std::size_t>(i)], axis.parameters[i],
                                 std::sqrt(axis.covariance(i, i))});
    for (Eigen::Index k = 0; k < count; ++k) record.covariance.push_back(axis.covariance(i, k));
  }
  return record;
}

TurntableCalibration CalibrateFromBoard(const TurntableInput& input, const Options& problem, int threads,
                                        FitOutcome* outcome) {
  const BoardViews boards = FindBoards(*input.board, BoardFrom(problem), threads);
  std::vector<AxisView> on_disk;
  for (const BoardView& view : boards.views) {
    if (view.angle) on_disk.push_back({*view.angle, view.corners, view.name});
  }
  outcome->metrics.Set("board_views", static_cast<std::int64_t>(boards.views.size()));
  outcome->metrics.Set("axis_views", static_cast<std::int64_t>(on_disk.size()));
  if (input.camera) CheckCamera(input.camera->camera, boards);
  const AxisOptions options{.free_angles = problem.Flag("calibration.free_angles"),
                            .angle_sigma = problem.Number("calibration.angle_sigma") * kDegree,
                            .free_camera = problem.Flag("calibration.free_camera"),
                            .threads = threads};
  const AxisCalibration axis = NameErrors(input.board->file.string(), [&] {
    const PinholeCamera camera = input.camera ? input.camera->camera : CameraOf(boards, problem, outcome);
    return CalibrateAxis(camera, on_disk, options);
  });
  AddWarnings(axis.warnings, outcome);
  outcome->metrics.Set("corner_sigma_px", axis.corner_sigma);
  SetEstimate("axis_distance", axis.distance, 1, &outcome->metrics);
  SetEstimate("tilt_degrees", axis.tilt, kDegree, &outcome->metrics);
  SetEstimate("roll_degrees", axis.roll, kDegree, &outcome->metrics);
  return {axis.rig, RecordOf(axis, input.unit)};
}

}  // namespace

std::vector<OptionSpec> TurntableCalibrationSpecs() {
  std::vector<OptionSpec> specs = BoardSpecs();
  const IntrinsicsOptions camera;
  const AxisOptions axis;
  for (OptionSpec& spec : std::vector<OptionSpec>{
           FlagSpec("calibration.square_pixels", camera.square_pixels, "fx = fy"),
           FlagSpec("calibration.centred", camera.centred, "The principal point in the image's middle"),
           FlagSpec("calibration.tangential_distortion", camera.tangential_distortion, "p1, p2"),
           IntegerSpec("calibration.radial_distortion", camera.radial_distortion, 0, 3,
                       "How many of k1, k2, k3"),
           FlagSpec("calibration.free_angles", axis.free_angles, "Correct the angles of the board's views"),
           NumberSpec("calibration.angle_sigma", 0, 0, 90,
                      "Degrees: standard deviation of the table's angles, where they are free; 0: unknown"),
           FlagSpec("calibration.free_camera", axis.free_camera,
                    "Fit the camera once more together with the axis")}) {
    specs.push_back(std::move(spec));
  }
  return specs;
}

TurntableCalibration CalibrateTurntable(const TurntableInput& input, const Options& problem, int threads,
                                        FitOutcome* outcome) {
  TurntableCalibration calibration;
  if (input.calibration) {
    calibration = *input.calibration;
    outcome->metrics.Set("axis_distance", calibration.rig.AxisDistance());
    outcome->metrics.Set("tilt_degrees", calibration.rig.Tilt() / kDegree);
    outcome->metrics.Set("roll_degrees", calibration.rig.Roll() / kDegree);
  } else {
    calibration = CalibrateFromBoard(input, problem, threads, outcome);
  }
  outcome->metrics.Set("calibration_rms", calibration.record.rms);
  outcome->files.push_back(
      {"calibration.json", [=](const std::filesystem::path& path) { WriteCalibration(path, calibration); }});
  return calibration;
}

}  // namespace frond
