// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "models/rectification.h"
#include "models/turntable_rig.h"

namespace frond {

// A calibrated parameter, for the record.
struct CalibratedParameter {
  std::string name;
  double value = 0;
  double sigma = 0;
};

struct CalibrationRecord {
  std::string unit = "mm";
  double rms = 0;                               // reprojection, px
  std::vector<CalibratedParameter> parameters;  // may be empty
  std::vector<double> covariance;               // of `parameters`, row by row; may be empty
};

struct TurntableCalibration {
  TurntableRig rig;
  CalibrationRecord record;
};

struct StereoPairCalibration {
  StereoPair pair;
  CalibrationRecord record;
};

struct CameraCalibration {
  PinholeCamera camera;
  CalibrationRecord record;
};

using Calibration = std::variant<TurntableCalibration, StereoPairCalibration, CameraCalibration>;

// calibration.json, schema frond.calibration/1 (docs/file_formats.md).
std::string FormatCalibration(const Calibration& calibration);
void WriteCalibration(const std::filesystem::path& path, const Calibration& calibration);

// What OpenCV's files do not tell: the unit and, where they have no image_width and image_height, the size of
// the images (0: unknown).
struct ForeignCalibration {
  std::string unit = "mm";
  int width = 0, height = 0;
};

// By extension and content: calibration.json, or OpenCV's own .yml, .yaml, .xml, .json with M1 D1 M2 D2 R T
// (a stereo pair) or camera_matrix and distortion_coefficients (a camera). Several of OpenCV's files are read
// as one, for intrinsics.yml beside extrinsics.yml. Throws InputError naming file and key.
Calibration ReadCalibration(const std::vector<std::filesystem::path>& paths,
                            const ForeignCalibration& foreign = {});
Calibration ReadCalibration(const std::filesystem::path& path, const ForeignCalibration& foreign = {});

}  // namespace frond
