// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"
#include "problems/skinning/skin.h"

namespace frond {

// An approximating skin brought nearer to its sections: least orthogonal distances (eq. 37) of two samples
// per control point of each section, in place of distances at the fixed (u, v[l]) of eq. (33), which count a
// shift along the surface as an error. What SkinCurves holds stays: weights, the first and last section,
// poles and the one tangent plane there. Gauss–Newton with all feet found anew, ten times at most; a tenth of
// the weight lies on moves along the surface and damps them. `sections` are those of the skin.
NurbsSurface RefitToSections(const Skin& skin, std::span<const NurbsCurve> sections,
                             const SkinOptions& options);

}  // namespace frond
