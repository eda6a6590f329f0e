// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/standard/problem_set.h"

namespace frond {

// `sphere_caps`: spheres through points of a part of a unit sphere, "cap_60" by its opening.
ProblemSetType SphereCapSetType();

}  // namespace frond
