// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: surface`: the distance fit of an open sheet in its principal frame.
FitType SurfaceFitType();

}  // namespace frond
