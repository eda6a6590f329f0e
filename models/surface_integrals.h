// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

// ∫∫ |S_u × S_v| du dv over the surface inside its trim, in the square of its unit; to 1e-6 of it or better
// where |S_u × S_v| is smooth. Without loops by Gauss points in every knot cell; with loops along lines of
// constant u between the loops' exact crossings, Gauss points in u between the vertices. The same bits in
// every run. Parts of loops outside the domain do not count.
double Area(const TrimmedSurface& surface);

// ∫ |C'| dt over [begin, end], or over the whole domain: Gauss points on every knot span, halved until the
// two halves agree with the whole to 1e-12 of the curve's length (or 30 times).
double ArcLength(const NurbsCurve& curve);
double ArcLength(const NurbsCurve& curve, double begin, double end);

}  // namespace frond
