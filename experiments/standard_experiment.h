// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/fit_type.h"

namespace frond {

// `standard`: one problem of a standard set, which takes no input.
FitType StandardFitType();

}  // namespace frond
