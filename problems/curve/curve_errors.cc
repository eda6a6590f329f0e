// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/curve_spans.h"

namespace frond {

CurveErrors MeasureCurveErrors(std::span<const Eigen::Vector3d> points, const CurveFit& fit) {
  const CurveSpans spans(fit.curve);
  const CurveIntegrals integrals = IntegrateCurve(spans);
  CurveErrors errors;
  errors.length = integrals.length;
  errors.barycentre = integrals.barycentre;
  double squared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = fit.distances[i];
    squared += distance * distance;
    errors.max = std::max(errors.max, distance);
    errors.perpendicular_total += distance;
    errors.parametric_total += (spans.Evaluate(fit.location_parameters[i]) - points[i]).norm();
    const double radius = (spans.Evaluate(fit.parameters[i]) - integrals.barycentre).norm();
    if (radius > 0) errors.relative_total += distance / radius;
  }
  const double n = static_cast<double>(points.size());
  errors.rmse = std::sqrt(squared / n);
  errors.mean = errors.perpendicular_mean = errors.perpendicular_total / n;
  errors.parametric_mean = errors.parametric_total / n;
  errors.relative_mean = errors.relative_total / n;
  std::vector<double> sorted = fit.distances;
  std::sort(sorted.begin(), sorted.end());
  errors.p95 = sorted[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
  return errors;
}

}  // namespace frond
