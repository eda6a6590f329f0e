// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/nurbs_curve.h"
#include "problems/skinning/section_planes.h"

namespace frond {

// How far section b is turned against section a about the line between them, in degrees: the mean over u of
// the difference of their points' angles, each measured from its plane's start about its section's
// barycentre.
double TwistDegrees(const NurbsCurve& a, const SectionPlane& plane_a, const NurbsCurve& b,
                    const SectionPlane& plane_b);

}  // namespace frond
