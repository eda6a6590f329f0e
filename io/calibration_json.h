// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/calibration_file.h"

namespace frond {

// To 1e-6 an entry of its Gram matrix.
bool IsRotation(const Eigen::Matrix3d& matrix);

// calibration.json from a text; `name` is how messages call it. Throws InputError naming it and the key.
Calibration ParseCalibrationJson(std::string_view text, const std::string& name);

}  // namespace frond
