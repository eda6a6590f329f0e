// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `problem.type: skin`: a surface through plane sections of a cloud (problems/skinning).
FitType SkinFitType();

}  // namespace frond
