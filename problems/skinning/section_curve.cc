// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "models/knot_vector.h"
#include "problems/curve/parametric_start.h"

namespace frond {
namespace {

constexpr double kFairness = 1e-6;

}  // namespace

std::vector<double> SectionParameters(std::span<const Eigen::Vector3d> points, const SectionPlane& plane,
                                      SectionParametrisation method) {
  std::vector<double> angle;
  for (const auto& point : points) angle.push_back(plane.Angle(point) / (2 * std::numbers::pi));
  if (method == SectionParametrisation::kBaseCurve || points.size() < 2) return angle;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return angle[a] < angle[b]; });
  const auto chord = [&](std::size_t a, std::size_t b) {
    const double length = (points[a] - points[b]).norm();
    return method == SectionParametrisation::kChord ? length : std::sqrt(length);
  };
  const std::size_t first = order.front(), last = order.back();
  const double gap = angle[first] + 1 - angle[last];
  std::vector<double> parameters(points.size(), 0.0);
  parameters[first] = chord(first, last) * (gap > 0 ? angle[first] / gap : 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    parameters[order[k]] = parameters[order[k - 1]] + chord(order[k], order[k - 1]);
  }
  const double whole = parameters[last] + chord(first, last) - parameters[first];
  if (!(whole > 0)) return angle;
  for (double& parameter : parameters) parameter /= whole;
  return parameters;
}

NurbsCurve FitSectionCurve(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                           int degree, int control_points) {
  // ∫|C″|² over [0, 1] is about n³ Σ|Δ²P|².
  const double fairness = kFairness / std::pow(control_points, 3);
  return FitCurveAtParameters(points, parameters, PeriodicUniformBasis(degree, control_points), fairness);
}

}  // namespace frond
