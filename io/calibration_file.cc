// SPDX-License-Identifier: BSD-3-Clause
#include "io/calibration_file.h"

#include <algorithm>

#include "base/errors.h"
#include "io/calibration_json.h"
#include "io/file_bytes.h"
#include "io/opencv_calibration.h"

namespace frond {
namespace {

// JSON without our schema may still be OpenCV's.
bool IsOurs(const std::filesystem::path& path) {
  return Extension(path) == "json" && ReadFileBytes(path).find("opencv-matrix") == std::string::npos;
}

}  // namespace

void WriteCalibration(const std::filesystem::path& path, const Calibration& calibration) {
  WriteFileBytes(path, FormatCalibration(calibration));
}

Calibration ReadCalibration(const std::vector<std::filesystem::path>& paths,
                            const ForeignCalibration& foreign) {
  if (paths.empty()) throw InputError("no file of a calibration is named");
  for (const std::filesystem::path& path : paths) {
    const std::string extension = Extension(path);
    if (extension != "json" && extension != "yml" && extension != "yaml" && extension != "xml") {
      FailFile(path, "is no calibration: expected calibration.json, or OpenCV's .yml, .yaml, .xml");
    }
    if (!IsOurs(path)) continue;
    if (paths.size() > 1) FailFile(path, "is a whole calibration: name it alone");
    return ParseCalibrationJson(ReadFileBytes(path), path.string());
  }
  return ReadOpencvCalibration(paths, foreign);
}

Calibration ReadCalibration(const std::filesystem::path& path, const ForeignCalibration& foreign) {
  return ReadCalibration(std::vector{path}, foreign);
}

}  // namespace frond
