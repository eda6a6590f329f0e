// SPDX-License-Identifier: BSD-3-Clause
// Open CASCADE's types: include this in io/cad_*.cc only.
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

// A face over the surface inside its trim. Every loop becomes a few edges; an edge's pcurve is a polyline and
// its curve in space the exact composition of surface and polyline, a B-spline of degree p + q, so that both
// agree to rounding. Segments that collapse to a point (a leaf's tip) become degenerated edges.
TopoDS_Face MakeFace(const TrimmedSurface& trimmed);

// What a CAD file holds of the surface: a solid, its face outward, where the untrimmed surface closes on
// itself (all its edges are seams or poles: a pear, a torus), else the face (a leaf, a tube, a cup).
TopoDS_Shape MakeShape(const TrimmedSurface& trimmed);

// The edge of a curve; a closed one has one vertex. Throws FitError where all of it is one point.
TopoDS_Edge MakeEdge(const NurbsCurve& curve);

// The face's surface, if it is a B-spline or Bézier surface (null otherwise), clamped and not periodic.
Handle(Geom_BSplineSurface) SplineOf(const TopoDS_Face& face);

// The edge's curve, in the edge's sense, clamped and not periodic; lines and conics become B-splines (null
// where there is no curve).
Handle(Geom_BSplineCurve) SplineOf(const TopoDS_Edge& edge);

// The face's wires as loops, the outer first; none where the wire is the surface's own boundary.
std::vector<TrimLoop> TrimOf(const TopoDS_Face& face, const NurbsSurface& surface);

}  // namespace frond
