// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: curve`: an open or closed NURBS curve by least distances.
FitType CurveFitType();

}  // namespace frond
