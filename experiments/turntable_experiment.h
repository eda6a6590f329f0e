// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: turntable`: photographs of an object on a turning disk to one cloud and a closed surface
// (problems/turntable), calibrated from views of a board on the disk.
FitType TurntableFitType();

}  // namespace frond
