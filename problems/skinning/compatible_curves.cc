// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/compatible_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "models/nurbs_operations.h"

namespace frond {
namespace {

constexpr double kSameKnot = 1e-9;

NurbsCurve WithKnots(const NurbsCurve& curve, std::vector<double> knots) {
  return NurbsCurve(BSplineBasis(curve.basis().degree(), std::move(knots), curve.basis().periodic()),
                    curve.control_points(), curve.weights());
}

NurbsCurve OverUnitInterval(const NurbsCurve& curve) {
  const double begin = curve.basis().begin(), length = curve.basis().end() - begin;
  if (begin == 0 && length == 1) return curve;
  std::vector<double> knots = curve.basis().knots();
  for (double& knot : knots) knot = (knot - begin) / length;
  return WithKnots(curve, std::move(knots));
}

// The distinct knots of all curves on [0, 1], the near-equal ones as the least of them.
std::vector<double> DistinctKnots(const std::vector<NurbsCurve>& curves) {
  std::vector<double> all = {0, 1};
  for (const NurbsCurve& curve : curves) {
    for (const double knot : curve.basis().knots()) {
      if (knot > 0 && knot < 1) all.push_back(knot);
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<double> distinct;
  for (const double knot : all) {
    if (distinct.empty() || knot - distinct.back() > kSameKnot) distinct.push_back(knot);
  }
  distinct.back() = 1;
  return distinct;
}

// The curve with each knot moved to the nearest of `distinct` (of another period where it lies outside).
NurbsCurve Snapped(const NurbsCurve& curve, const std::vector<double>& distinct) {
  std::vector<double> knots = curve.basis().knots();
  for (double& knot : knots) {
    double period = 0;
    if (curve.basis().periodic()) period = knot < 0 ? std::floor(knot) : knot > 1 ? std::ceil(knot) - 1 : 0;
    for (const double value : distinct) {
      if (std::abs(knot - period - value) <= kSameKnot) knot = value + period;
    }
  }
  return WithKnots(curve, std::move(knots));
}

std::ptrdiff_t Multiplicity(const NurbsCurve& curve, double knot) {
  const std::vector<double>& knots = curve.basis().knots();
  return std::count(knots.begin(), knots.end(), knot);
}

}  // namespace

std::vector<NurbsCurve> MakeCompatible(std::vector<NurbsCurve> curves) {
  if (curves.empty()) throw InputError("there are no section curves");
  int degree = 0;
  bool periodic = true;
  for (const NurbsCurve& curve : curves) {
    degree = std::max(degree, curve.basis().degree());
    periodic = periodic && curve.basis().periodic();
  }
  for (NurbsCurve& curve : curves) {
    curve = OverUnitInterval(periodic ? curve : Clamped(curve));
    if (curve.basis().degree() < degree) curve = ElevateDegree(curve, degree - curve.basis().degree());
  }
  const std::vector<double> distinct = DistinctKnots(curves);
  for (NurbsCurve& curve : curves) curve = Snapped(curve, distinct);
  std::vector<std::ptrdiff_t> wanted(distinct.size(), 0);
  for (std::size_t k = 0; k + 1 < distinct.size(); ++k) {  // 1 is 0 again, or clamped in every curve
    for (const NurbsCurve& curve : curves) wanted[k] = std::max(wanted[k], Multiplicity(curve, distinct[k]));
  }
  for (NurbsCurve& curve : curves) {
    std::vector<double> missing;
    for (std::size_t k = periodic ? 0 : 1; k + 1 < distinct.size(); ++k) {
      const auto count = static_cast<std::size_t>(wanted[k] - Multiplicity(curve, distinct[k]));
      missing.insert(missing.end(), count, distinct[k]);
    }
    if (!missing.empty()) curve = InsertKnots(curve, missing);
  }
  // To the bit: knot insertion over several periods leaves images of a knot apart by a rounding.
  for (NurbsCurve& curve : curves) curve = WithKnots(curve, curves.front().basis().knots());
  return curves;
}

}  // namespace frond
