// SPDX-License-Identifier: BSD-3-Clause
// Open CASCADE's types: include this in io/cad_*.cc only.
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <gp_Pnt.hxx>
#include <vector>

#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

inline gp_Pnt ToPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

template <typename Array, typename T>
Array ToArray(const std::vector<T>& values) {
  Array array(1, static_cast<int>(values.size()));
  for (int k = 0; k < static_cast<int>(values.size()); ++k)
    array(k + 1) = values[static_cast<std::size_t>(k)];
  return array;
}

// Below this distance two points are one. Coordinates far from the origin (UTM) hold no more digits than
// that.
double Tolerance(const NurbsSurface& surface);
double Tolerance(const NurbsCurve& curve);

// The same surface or curve, same parameters; directions that are not clamped (periodic ones) become so by
// knot insertion.
Handle(Geom_BSplineSurface) ToOpenCascade(const NurbsSurface& surface);
Handle(Geom_BSplineCurve) ToOpenCascade(const NurbsCurve& curve);

// Of clamped ones.
NurbsSurface FromOpenCascade(const Geom_BSplineSurface& surface);
NurbsCurve FromOpenCascade(const Geom_BSplineCurve& curve);

}  // namespace frond
