// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "models/nurbs_curve.h"

namespace frond {

// The same curves over one degree and one knot vector on [0, 1], as skinning needs them (acquisition paper,
// section 3.3.2): degrees raised to the largest, then every curve given the knots that the others have
// (Boehm). Knots nearer than 1e-9 count as one, which moves a curve by as little. All stay periodic if all
// are; else closed curves become open ones whose ends meet. Curves that agree already come back as they are,
// but for the domain. Throws InputError if there are none.
std::vector<NurbsCurve> MakeCompatible(std::vector<NurbsCurve> curves);

}  // namespace frond
