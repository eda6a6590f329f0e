// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/standard/problem_set.h"

namespace frond {

// `nist`: the 27 regressions of nist_data.h as NistFit, "misra1a_1", "misra1a_2" by start, or once each as
// "misra1a" for starts drawn from the box.
ProblemSetType NistSetType();

}  // namespace frond
