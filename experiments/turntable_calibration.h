// SPDX-License-Identifier: BSD-3-Clause
// A turntable's calibration within a run: from views of a board, or from a file.
#pragma once

#include <vector>

#include "base/options.h"
#include "experiments/fit_type.h"
#include "io/calibration_file.h"

namespace frond {

// `board.*` and `calibration.*`.
std::vector<OptionSpec> TurntableCalibrationSpecs();

// The input's calibration, or one by its board: the camera from all views (unless the input has it), the axis
// from those with an angle. Adds metrics, warnings and calibration.json to the outcome. Throws InputError and
// FitError.
TurntableCalibration CalibrateTurntable(const TurntableInput& input, const Options& problem, int threads,
                                        FitOutcome* outcome);

}  // namespace frond
