// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_curve.h"
#include "models/surface_cells.h"

namespace frond {

// A curve as one polynomial in homogeneous coordinates for each non-empty knot span, evaluated by Horner's
// rule: the fast path for many points, as SurfaceCells is for surfaces.
class CurveSpans {
 public:
  explicit CurveSpans(const NurbsCurve& curve);

  // New control points and weights (all counts as before), for example at each iterate of a fit.
  void Update(std::span<const Eigen::Vector3d> control_points, std::span<const double> weights);

  const BSplineBasis& basis() const { return basis_; }
  const SpanPolynomials& polynomials() const { return polynomials_; }
  int count() const { return polynomials_.count(); }

  // t in the domain. Without allocation; re-entrant.
  Eigen::Vector3d Evaluate(double t) const;
  CurvePoint EvaluateWithDerivatives(double t) const;

 private:
  BSplineBasis basis_;
  SpanPolynomials polynomials_;
  std::vector<Eigen::Array4d> coefficients_;  // span-major, then power: (x, y, z, w)
};

struct CurveIntegrals {
  double length = 0;
  Eigen::Vector3d barycentre = Eigen::Vector3d::Zero();  // of the curve as a wire of even density
};

// By Gauss–Legendre rule: 5 points in each eighth of a span.
CurveIntegrals IntegrateCurve(const CurveSpans& spans);

// About `per_span` points a span, along the curve; of a closed one the first comes again at the end.
std::vector<Eigen::Vector3d> CurvePolyline(const CurveSpans& spans, int per_span);

}  // namespace frond
