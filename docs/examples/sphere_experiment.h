// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `sphere`: a sphere through a cloud.
FitType SphereFitType();

}  // namespace frond
