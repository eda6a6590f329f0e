// SPDX-License-Identifier: BSD-3-Clause
#include "models/nurbs_curve.h"

#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

// Σ N^(d) (wP, w) for d = 0, 1, 2, a column each; t in the domain.
Eigen::Matrix<double, 4, 3> EvaluateHomogeneous(const NurbsCurve& curve, double t, int order) {
  double values[3 * (kMaxDegree + 1)];
  const int p = curve.basis().degree();
  const int span = curve.basis().FindSpan(t);
  curve.basis().Evaluate(span, t, order, values);
  Eigen::Matrix<double, 4, 3> sums = Eigen::Matrix<double, 4, 3>::Zero();
  for (int k = 0; k <= p; ++k) {
    const auto i = static_cast<std::size_t>(span - p + k);
    const double w = curve.weights()[i];
    const Eigen::Vector4d point = (Eigen::Vector4d() << w * curve.control_points()[i], w).finished();
    for (int d = 0; d <= order; ++d) sums.col(d) += values[d * (p + 1) + k] * point;
  }
  return sums;
}

void CheckAndClosePeriodic(const BSplineBasis& basis, std::vector<Eigen::Vector3d>& points,
                           std::vector<double>& weights) {
  double extent = 0;
  for (const auto& point : points) extent = std::max(extent, (point - points[0]).norm());
  const auto distinct = static_cast<std::size_t>(basis.num_distinct_control_points());
  for (std::size_t i = distinct; i < points.size(); ++i) {
    const std::size_t original = i - distinct;
    if ((points[i] - points[original]).norm() > 1e-9 * extent ||
        std::abs(weights[i] - weights[original]) > 1e-9 * weights[original]) {
      throw InputError("a periodic curve's last control points do not repeat its first ones");
    }
    points[i] = points[original];
    weights[i] = weights[original];
  }
}

}  // namespace

NurbsCurve::NurbsCurve(BSplineBasis basis, std::vector<Eigen::Vector3d> control_points,
                       std::vector<double> weights)
    : basis_(std::move(basis)), control_points_(std::move(control_points)), weights_(std::move(weights)) {
  const auto expected = static_cast<std::size_t>(basis_.num_control_points());
  if (weights_.empty()) weights_.assign(expected, 1.0);
  if (control_points_.size() != expected || weights_.size() != expected) {
    throw InputError("the knot vector asks for " + std::to_string(expected) +
                     " control points and weights, not " + std::to_string(control_points_.size()) + " and " +
                     std::to_string(weights_.size()));
  }
  for (std::size_t k = 0; k < expected; ++k) {
    if (!control_points_[k].allFinite())
      throw InputError("control point " + std::to_string(k) + " is not finite");
    if (!(weights_[k] > 0) || !std::isfinite(weights_[k])) {
      throw InputError("weight " + std::to_string(k) + " is not a positive number");
    }
  }
  CheckAndClosePeriodic(basis_, control_points_, weights_);
}

Eigen::Vector3d NurbsCurve::Evaluate(double t) const {
  const Eigen::Vector4d h = EvaluateHomogeneous(*this, basis_.IntoDomain(t), 0).col(0);
  return h.head<3>() / h[3];
}

CurvePoint NurbsCurve::EvaluateWithDerivatives(double t) const {
  const Eigen::Matrix<double, 4, 3> sums = EvaluateHomogeneous(*this, basis_.IntoDomain(t), 2);
  const auto w = sums.row(3);
  CurvePoint c;  // The NURBS Book, eq. (4.8)
  c.position = sums.col(0).head<3>() / w[0];
  c.d1 = (sums.col(1).head<3>() - w[1] * c.position) / w[0];
  c.d2 = (sums.col(2).head<3>() - 2 * w[1] * c.d1 - w[2] * c.position) / w[0];
  return c;
}

}  // namespace frond
