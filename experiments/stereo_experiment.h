// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: stereo`: disparities of a rectified pair, a cloud of a calibrated one, displacements of two
// images of a specimen (problems/stereo); and the calibration of a pair from views of a board.
FitType StereoFitType();

}  // namespace frond
