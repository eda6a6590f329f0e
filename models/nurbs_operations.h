// SPDX-License-Identifier: BSD-3-Clause
// Operations that keep the shape of a rational curve or surface (to rounding) and change its description, or
// move it. Algorithm numbers are those of Piegl and Tiller, The NURBS Book. Parameters named t that are
// nearer than 1e-12 of the domain's length to a knot stand for that knot. InputError where a parameter is
// outside the domain, a knot's multiplicity would exceed the degree, or the degree kMaxDegree.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <utility>

#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

enum class Direction { kU, kV };

// Knots added, each as often as it is listed (A5.1, A5.3). In a periodic direction the same knot is added in
// every period; the ends of the domain (its seam) may be refined too.
NurbsCurve InsertKnots(const NurbsCurve& curve, std::span<const double> knots);
NurbsSurface InsertKnots(const NurbsSurface& surface, Direction direction, std::span<const double> knots);

// Every non-empty span halved.
NurbsCurve Refine(const NurbsCurve& curve);
NurbsSurface Refine(const NurbsSurface& surface, Direction direction);

// Degree raised by `by` ≥ 0 (the result of A5.9, A5.10). Unclamped ends of a direction that is not periodic
// become clamped.
NurbsCurve ElevateDegree(const NurbsCurve& curve, int by = 1);
NurbsSurface ElevateDegree(const NurbsSurface& surface, Direction direction, int by = 1);

// The part over [begin, end] with begin < end inside the domain: clamped, not periodic, over the same
// parameters.
NurbsCurve Part(const NurbsCurve& curve, double begin, double end);
NurbsSurface Part(const NurbsSurface& surface, Direction direction, double begin, double end);

// The same curve or surface with clamped ends; a periodic direction becomes an open one whose ends meet.
NurbsCurve Clamped(const NurbsCurve& curve);
NurbsSurface Clamped(const NurbsSurface& surface, Direction direction);

// The parts before and after t, which lies strictly inside the domain; a periodic direction is cut at its
// seam as well.
std::pair<NurbsCurve, NurbsCurve> Split(const NurbsCurve& curve, double t);
std::pair<NurbsSurface, NurbsSurface> Split(const NurbsSurface& surface, Direction direction, double t);

// C(begin + end − t). A surface's normals turn over.
NurbsCurve Reversed(const NurbsCurve& curve);
NurbsSurface Reversed(const NurbsSurface& surface, Direction direction);

// S(v, u). Normals turn over.
NurbsSurface Transposed(const NurbsSurface& surface);

// The image under a motion or any other affine map (an Eigen::Isometry3d converts).
NurbsCurve Transformed(const NurbsCurve& curve, const Eigen::Affine3d& map);
NurbsSurface Transformed(const NurbsSurface& surface, const Eigen::Affine3d& map);

// The curve on the surface where `fixed` has parameter t and the other runs; t is moved into the domain.
NurbsCurve IsoCurve(const NurbsSurface& surface, Direction fixed, double t);

// The box of the control points, which holds the curve or surface (weights are positive).
Eigen::AlignedBox3d BoundingBox(const NurbsCurve& curve);
Eigen::AlignedBox3d BoundingBox(const NurbsSurface& surface);

}  // namespace frond
