// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/nurbs_surface.h"

namespace frond {

// The volume inside a surface that is closed in u, in the cube of its unit, positive where its normals point
// outwards: ⅓ ∮ x · n by the divergence theorem, Gauss points in every knot cell. Open ends of v are closed
// by the cone from the rim to its barycentre. Throws InputError where u is not closed.
double EnclosedVolume(const NurbsSurface& surface);

// The volume between two such surfaces, one inside the other, whose rims (of which both have the same number)
// are joined by straight lines from each point of the one to the nearest in angle of the other.
double VolumeBetween(const NurbsSurface& outer, const NurbsSurface& inner);

}  // namespace frond
