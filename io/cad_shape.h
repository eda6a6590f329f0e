// SPDX-License-Identifier: BSD-3-Clause
// Open CASCADE's types: include this in io/cad_*.cc only.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Face.hxx>

#include "models/nurbs_surface.h"

namespace frond {

// The same surface, same parameters; directions that are not clamped (periodic ones) become so by knot
// insertion.
Handle(Geom_BSplineSurface) ToOpenCascade(const NurbsSurface& surface);

// A face over the surface inside its trim. Every loop becomes a few edges; an edge's pcurve is a polyline and
// its curve in space the exact composition of surface and polyline, a B-spline of degree p + q, so that both
// agree to rounding. Segments that collapse to a point (a leaf's tip) become degenerated edges.
TopoDS_Face MakeFace(const TrimmedSurface& trimmed);

// The face's surface, if it is a B-spline or Bézier surface (null otherwise), clamped and not periodic.
Handle(Geom_BSplineSurface) SplineOf(const TopoDS_Face& face);

NurbsSurface FromOpenCascade(const Geom_BSplineSurface& surface);

// The face's wires as loops, the outer first; none where the wire is the surface's own boundary.
std::vector<TrimLoop> TrimOf(const TopoDS_Face& face, const NurbsSurface& surface);

}  // namespace frond
