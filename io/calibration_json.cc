// SPDX-License-Identifier: BSD-3-Clause
#include "io/calibration_json.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "io/length_unit.h"
#include "io/nurbs_json.h"

namespace frond {
namespace {

constexpr const char* kSchema = "frond.calibration/1";
constexpr double kRotationTolerance = 1e-6;  // of RᵀR from the identity

std::string Quoted(const std::string& text) {
  // File names may hold bytes that are not UTF-8.
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string NumberList(std::span<const double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number))
      throw std::invalid_argument("a calibration holds a number that is not finite");
  }
  std::string text;
  AppendNumbers(numbers, &text);
  return text;
}

std::string NumberText(double number) {
  const std::string list = NumberList({&number, 1});
  return list.substr(1, list.size() - 2);
}

std::string FormatCamera(const PinholeCamera& camera) {
  return "{\n    \"width\": " + std::to_string(camera.width) +
         ",\n    \"height\": " + std::to_string(camera.height) +
         ",\n    \"focal\": " + NumberList(camera.focal) +
         ",\n    \"distortion\": " + NumberList(camera.distortion) + "\n  }";
}

// [R t], 3 rows of 4.
std::string FormatPose(const Eigen::Isometry3d& pose) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::array<double, 4> row = {pose(i, 0), pose(i, 1), pose(i, 2), pose(i, 3)};
    text += (i > 0 ? ",\n    " : "\n    ") + NumberList(row);
  }
  return text + "]";
}

std::string FormatRecord(const CalibrationRecord& record) {
  std::string text = ",\n  \"rms\": " + NumberText(record.rms) + ",\n  \"parameters\": [";
  for (std::size_t k = 0; k < record.parameters.size(); ++k) {
    const CalibratedParameter& parameter = record.parameters[k];
    text += (k > 0 ? ",\n    {\"name\": " : "\n    {\"name\": ") + Quoted(parameter.name) +
            ", \"value\": " + NumberText(parameter.value) + ", \"sigma\": " + NumberText(parameter.sigma) +
            "}";
  }
  text += "],\n  \"covariance\": [";
  const std::size_t count = record.covariance.empty() ? 0 : record.parameters.size();
  if (record.covariance.size() != count * count) {
    throw std::invalid_argument("a calibration's covariance is not of its parameters");
  }
  for (std::size_t k = 0; k < count; ++k) {
    text += (k > 0 ? ",\n    " : "\n    ") + NumberList({&record.covariance[k * count], count});
  }
  return text + "]\n}\n";
}

std::string Head(const char* kind, const CalibrationRecord& record) {
  MetresPerUnit(record.unit);  // throws unless known, hence plain text
  return std::string("{\n  \"schema\": \"") + kSchema + "\",\n  \"kind\": \"" + kind + "\",\n  \"unit\": \"" +
         record.unit + "\"";
}

struct Formatter {
  std::string operator()(const TurntableCalibration& c) const {
    return Head("turntable", c.record) + ",\n  \"camera\": " + FormatCamera(c.rig.camera) +
           ",\n  \"camera_from_disk\": " + FormatPose(c.rig.camera_from_disk) + FormatRecord(c.record);
  }
  std::string operator()(const StereoPairCalibration& c) const {
    return Head("stereo", c.record) + ",\n  \"left\": " + FormatCamera(c.pair.left) +
           ",\n  \"right\": " + FormatCamera(c.pair.right) +
           ",\n  \"right_from_left\": " + FormatPose(c.pair.right_from_left) + FormatRecord(c.record);
  }
  std::string operator()(const CameraCalibration& c) const {
    return Head("camera", c.record) + ",\n  \"camera\": " + FormatCamera(c.camera) + FormatRecord(c.record);
  }
};

int ParseSize(const JsonPlace& place) {
  const double size = place.Number();
  if (!(size >= 0 && size <= 1e6) || size != std::floor(size)) place.Fail("expected a number of pixels");
  return static_cast<int>(size);
}

PinholeCamera ParseCamera(const JsonPlace& place) {
  if (!place.value().is_object()) place.Fail("expected a camera: {width, height, focal, distortion}");
  PinholeCamera camera;
  camera.width = ParseSize(place.Member("width"));
  camera.height = ParseSize(place.Member("height"));
  const JsonPlace focal = place.Member("focal"), distortion = place.Member("distortion");
  focal.ListSize(4);
  distortion.ListSize(5);
  for (std::size_t k = 0; k < 4; ++k) camera.focal[k] = focal.Item(k).Number();
  for (std::size_t k = 0; k < 5; ++k) camera.distortion[k] = distortion.Item(k).Number();
  if (!(camera.focal[0] > 0 && camera.focal[1] > 0)) focal.Fail("fx and fy must be positive");
  return camera;
}

Eigen::Isometry3d ParsePose(const JsonPlace& place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  place.ListSize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const JsonPlace row = place.Item(i);
    row.ListSize(4);
    for (std::size_t j = 0; j < 4; ++j) {
      pose(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row.Item(j).Number();
    }
  }
  if (!IsRotation(pose.linear())) place.Fail("its first three columns are no rotation");
  return pose;
}

CalibrationRecord ParseRecord(const JsonPlace& root) {
  CalibrationRecord record;
  record.unit = ParseUnit(root);
  record.rms = root.Member("rms").Number();
  const JsonPlace parameters = root.Member("parameters"), covariance = root.Member("covariance");
  for (std::size_t k = 0; k < parameters.ListSize(); ++k) {
    const JsonPlace parameter = parameters.Item(k), name = parameter.Member("name");
    if (!name.value().is_string()) name.Fail("expected text");
    record.parameters.push_back({name.value().get<std::string>(), parameter.Member("value").Number(),
                                 parameter.Member("sigma").Number()});
  }
  if (covariance.ListSize() == 0) return record;
  covariance.ListSize(record.parameters.size());
  for (std::size_t k = 0; k < record.parameters.size(); ++k) {
    covariance.Item(k).ListSize(record.parameters.size());
    for (const double value : covariance.Item(k).Numbers()) record.covariance.push_back(value);
  }
  return record;
}

}  // namespace

bool IsRotation(const Eigen::Matrix3d& matrix) {
  return (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
             kRotationTolerance &&
         matrix.determinant() > 0;
}

std::string FormatCalibration(const Calibration& calibration) { return std::visit(Formatter(), calibration); }

Calibration ParseCalibrationJson(std::string_view text, const std::string& name) {
  const nlohmann::json document = ParseJsonText(text, name);
  const JsonPlace root(document, name);
  CheckSchema(root, kSchema);
  const JsonPlace kind = root.Member("kind");
  CalibrationRecord record = ParseRecord(root);
  if (kind.value() == "turntable") {
    return TurntableCalibration{{.camera = ParseCamera(root.Member("camera")),
                                 .camera_from_disk = ParsePose(root.Member("camera_from_disk"))},
                                std::move(record)};
  }
  if (kind.value() == "stereo") {
    return StereoPairCalibration{{.left = ParseCamera(root.Member("left")),
                                  .right = ParseCamera(root.Member("right")),
                                  .right_from_left = ParsePose(root.Member("right_from_left"))},
                                 std::move(record)};
  }
  if (kind.value() == "camera") {
    return CameraCalibration{ParseCamera(root.Member("camera")), std::move(record)};
  }
  kind.Fail("expected \"turntable\", \"stereo\" or \"camera\"");
}

}  // namespace frond
