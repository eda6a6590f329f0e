// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "io/calibration_file.h"

namespace frond {

// OpenCV's own files (cv::FileStorage: YAML, XML or JSON), all read as one: M1 D1 M2 D2 R T, a pair, or
// camera_matrix and distortion_coefficients, a camera; image_width and image_height where they are given.
// Throws InputError naming the file and the key.
Calibration ReadOpencvCalibration(const std::vector<std::filesystem::path>& paths,
                                  const ForeignCalibration& foreign);

}  // namespace frond
