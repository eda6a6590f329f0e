// SPDX-License-Identifier: BSD-3-Clause
#include "models/curve_spans.h"

#include <cmath>

namespace frond {

CurveSpans::CurveSpans(const NurbsCurve& curve) : basis_(curve.basis()), polynomials_(basis_) {
  coefficients_.resize(static_cast<std::size_t>(count() * (basis_.degree() + 1)));
  Update(curve.control_points(), curve.weights());
}

void CurveSpans::Update(std::span<const Eigen::Vector3d> control_points, std::span<const double> weights) {
  const int p = basis_.degree();
  for (int k = 0; k < count(); ++k) {
    const Eigen::MatrixXd& c = polynomials_.coefficients(k);
    for (int m = 0; m <= p; ++m) {
      Eigen::Array4d sum = Eigen::Array4d::Zero();
      for (int a = 0; a <= p; ++a) {
        const auto i = static_cast<std::size_t>(polynomials_.first(k) + a);
        const double factor = c(a, m) * weights[i];
        sum.head<3>() += factor * control_points[i].array();
        sum[3] += factor;
      }
      coefficients_[static_cast<std::size_t>(k * (p + 1) + m)] = sum;
    }
  }
}

Eigen::Vector3d CurveSpans::Evaluate(double t) const {
  const int k = polynomials_.SpanOf(t), p = basis_.degree();
  const double s = (t - polynomials_.begin(k)) / polynomials_.length(k);
  const Eigen::Array4d* c = &coefficients_[static_cast<std::size_t>(k * (p + 1))];
  Eigen::Array4d h = c[p];
  for (int m = p - 1; m >= 0; --m) h = h * s + c[m];
  return (h.head<3>() / h[3]).matrix();
}

CurvePoint CurveSpans::EvaluateWithDerivatives(double t) const {
  const int k = polynomials_.SpanOf(t), p = basis_.degree();
  const double inverse = 1 / polynomials_.length(k), s = (t - polynomials_.begin(k)) * inverse;
  const Eigen::Array4d* c = &coefficients_[static_cast<std::size_t>(k * (p + 1))];
  Eigen::Array4d h = c[p], h1 = Eigen::Array4d::Zero(), h2 = Eigen::Array4d::Zero();
  for (int m = p - 1; m >= 0; --m) {
    h2 = h2 * s + 2 * h1;
    h1 = h1 * s + h;
    h = h * s + c[m];
  }
  h1 *= inverse;
  h2 *= inverse * inverse;
  CurvePoint point;  // The NURBS Book, eq. (4.8)
  const double scale = 1 / h[3];
  point.position = h.head<3>().matrix() * scale;
  point.d1 = (h1.head<3>().matrix() - h1[3] * point.position) * scale;
  point.d2 = (h2.head<3>().matrix() - 2 * h1[3] * point.d1 - h2[3] * point.position) * scale;
  return point;
}

CurveIntegrals IntegrateCurve(const CurveSpans& spans) {
  constexpr int kParts = 8;
  constexpr double kNodes[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                               0.9061798459386640};
  constexpr double kWeights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                 0.4786286704993665, 0.2369268850561891};
  CurveIntegrals integrals;
  for (int k = 0; k < spans.count(); ++k) {
    const double half = spans.polynomials().length(k) / (2 * kParts);
    for (int part = 0; part < kParts; ++part) {
      const double middle = spans.polynomials().begin(k) + half * (2 * part + 1);
      for (std::size_t i = 0; i < 5; ++i) {
        const CurvePoint point = spans.EvaluateWithDerivatives(middle + half * kNodes[i]);
        const double length = half * kWeights[i] * point.d1.norm();
        integrals.length += length;
        integrals.barycentre += length * point.position;
      }
    }
  }
  if (integrals.length > 0) integrals.barycentre /= integrals.length;
  return integrals;
}

std::vector<Eigen::Vector3d> CurvePolyline(const CurveSpans& spans, int per_span) {
  std::vector<Eigen::Vector3d> polyline;
  for (int k = 0; k < spans.count(); ++k) {
    for (int i = 0; i < per_span; ++i) {
      polyline.push_back(
          spans.Evaluate(spans.polynomials().begin(k) + spans.polynomials().length(k) * i / per_span));
    }
  }
  polyline.push_back(spans.Evaluate(spans.basis().end()));
  return polyline;
}

}  // namespace frond
