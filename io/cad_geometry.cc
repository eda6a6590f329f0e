// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_geometry.h"

#include <Precision.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <limits>

namespace frond {
namespace {

struct KnotRuns {
  std::vector<double> knots;
  std::vector<int> multiplicities;
};

KnotRuns RunsOf(const std::vector<double>& knots) {
  KnotRuns runs;
  for (const double knot : knots) {
    if (runs.knots.empty() || knot != runs.knots.back()) {
      runs.knots.push_back(knot);
      runs.multiplicities.push_back(0);
    }
    ++runs.multiplicities.back();
  }
  return runs;
}

bool IsClamped(const BSplineBasis& basis) {
  const auto& knots = basis.knots();
  return knots.front() == basis.begin() && knots.back() == basis.end();
}

double ToleranceOf(const std::vector<Eigen::Vector3d>& points) {
  double largest = 0;
  for (const auto& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return std::max(Precision::Confusion(), 16 * std::numeric_limits<double>::epsilon() * largest);
}

std::vector<double> Flat(const TColStd_Array1OfReal& sequence) { return {sequence.begin(), sequence.end()}; }

}  // namespace

double Tolerance(const NurbsSurface& surface) { return ToleranceOf(surface.control_points()); }
double Tolerance(const NurbsCurve& curve) { return ToleranceOf(curve.control_points()); }

Handle(Geom_BSplineSurface) ToOpenCascade(const NurbsSurface& surface) {
  const KnotRuns u = RunsOf(surface.u().knots()), v = RunsOf(surface.v().knots());
  TColgp_Array2OfPnt poles(1, surface.count_u(), 1, surface.count_v());
  TColStd_Array2OfReal weights(1, surface.count_u(), 1, surface.count_v());
  for (int i = 0; i < surface.count_u(); ++i) {
    for (int j = 0; j < surface.count_v(); ++j) {
      poles(i + 1, j + 1) = ToPoint(surface.control_point(i, j));
      weights(i + 1, j + 1) = surface.weight(i, j);
    }
  }
  const auto knots_u = ToArray<TColStd_Array1OfReal>(u.knots),
             knots_v = ToArray<TColStd_Array1OfReal>(v.knots);
  const auto runs_u = ToArray<TColStd_Array1OfInteger>(u.multiplicities);
  const auto runs_v = ToArray<TColStd_Array1OfInteger>(v.multiplicities);
  const int p = surface.u().degree(), q = surface.v().degree();
  Handle(Geom_BSplineSurface) spline =
      surface.IsRational() ? new Geom_BSplineSurface(poles, weights, knots_u, knots_v, runs_u, runs_v, p, q)
                           : new Geom_BSplineSurface(poles, knots_u, knots_v, runs_u, runs_v, p, q);
  if (!IsClamped(surface.u()) || !IsClamped(surface.v())) {
    spline->Segment(surface.u().begin(), surface.u().end(), surface.v().begin(), surface.v().end());
  }
  return spline;
}

Handle(Geom_BSplineCurve) ToOpenCascade(const NurbsCurve& curve) {
  const KnotRuns runs = RunsOf(curve.basis().knots());
  std::vector<gp_Pnt> points;
  for (const auto& point : curve.control_points()) points.push_back(ToPoint(point));
  const auto poles = ToArray<TColgp_Array1OfPnt>(points);
  const auto knots = ToArray<TColStd_Array1OfReal>(runs.knots);
  const auto multiplicities = ToArray<TColStd_Array1OfInteger>(runs.multiplicities);
  const int degree = curve.basis().degree();
  const auto& weights = curve.weights();
  const bool rational =
      std::any_of(weights.begin(), weights.end(), [&](double weight) { return weight != weights.front(); });
  Handle(Geom_BSplineCurve) spline =
      rational ? new Geom_BSplineCurve(poles, ToArray<TColStd_Array1OfReal>(weights), knots, multiplicities,
                                       degree)
               : new Geom_BSplineCurve(poles, knots, multiplicities, degree);
  if (!IsClamped(curve.basis())) spline->Segment(curve.basis().begin(), curve.basis().end());
  return spline;
}

NurbsSurface FromOpenCascade(const Geom_BSplineSurface& s) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 1; i <= s.NbUPoles(); ++i) {
    for (int j = 1; j <= s.NbVPoles(); ++j) {
      const gp_Pnt point = s.Pole(i, j);
      points.emplace_back(point.X(), point.Y(), point.Z());
      // Of a surface that is not rational Open CASCADE may hold zeros for weights.
      if (s.IsURational() || s.IsVRational()) weights.push_back(s.Weight(i, j));
    }
  }
  return {BSplineBasis(s.UDegree(), Flat(s.UKnotSequence())),
          BSplineBasis(s.VDegree(), Flat(s.VKnotSequence())), std::move(points), std::move(weights)};
}

NurbsCurve FromOpenCascade(const Geom_BSplineCurve& c) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 1; i <= c.NbPoles(); ++i) {
    const gp_Pnt point = c.Pole(i);
    points.emplace_back(point.X(), point.Y(), point.Z());
    if (c.IsRational()) weights.push_back(c.Weight(i));
  }
  return {BSplineBasis(c.Degree(), Flat(c.KnotSequence())), std::move(points), std::move(weights)};
}

}  // namespace frond
