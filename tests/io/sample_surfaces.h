// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of every kind that files must hold.
#pragma once

#include <string>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

struct SampleSurface {
  std::string name;
  TrimmedSurface trimmed;
};

// Bicubic 8 × 6 and others: plain, rational, trimmed (with a hole), both, with a collapsed tip, with a tip
// and a trim that runs along it, periodic (a tube), periodic and rational, closed (pear, ring, sphere), a
// cup, far from the origin, of degree (1, 1) and (5, 4).
std::vector<SampleSurface> SampleSurfaces();

// A wavy sheet, about 60 × 40, of the given degrees and counts.
NurbsSurface WavySheet(int degree_u, int degree_v, int count_u, int count_v, bool rational);

// A pear along z, `length` long and about 0.7 of it thick, closed in u, a pole at each end of v, where it is
// smooth (C1): u runs counter-clockwise about z, so that the normal looks outward, or clockwise.
NurbsSurface Pear(double length, bool clockwise = false);

// The same without the upper part: one pole, an open rim.
NurbsSurface Cup();

// Closed in both directions: a bent ring, about 30 across.
NurbsSurface Ring();

// Exact: a half circle turned about z. Not periodic; its first and last rows of control points coincide.
NurbsSurface Sphere(double radius);

// A leaf-like outline of `vertices` points within the unit square.
TrimLoop LeafOutline(int vertices);

}  // namespace frond
