// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: leaf`: the paper's method (Wu et al. 2021) or the distance fit, in the leaf's own frame.
FitType LeafFitType();

}  // namespace frond
