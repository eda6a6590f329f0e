// SPDX-License-Identifier: BSD-3-Clause
#include "models/nurbs_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

constexpr int kMaxBasis = 3 * (kMaxDegree + 1);

// Homogeneous sums Σ N^(a) N^(b) (wP, w) for a + b ≤ 2, in the order 00, 10, 01, 20, 11, 02.
using HomogeneousJet = Eigen::Matrix<double, 4, 6>;

HomogeneousJet EvaluateHomogeneous(const NurbsSurface& s, double u, double v, int order) {
  double nu[kMaxBasis], nv[kMaxBasis];
  const int p = s.u().degree(), q = s.v().degree();
  const int span_u = s.u().FindSpan(u), span_v = s.v().FindSpan(v);
  s.u().Evaluate(span_u, u, order, nu);
  s.v().Evaluate(span_v, v, order, nv);
  HomogeneousJet jet = HomogeneousJet::Zero();
  for (int a = 0; a <= p; ++a) {
    Eigen::Matrix<double, 4, 3> row = Eigen::Matrix<double, 4, 3>::Zero();
    for (int b = 0; b <= q; ++b) {
      const int i = span_u - p + a, j = span_v - q + b;
      const double w = s.weight(i, j);
      const Eigen::Vector4d point = (Eigen::Vector4d() << w * s.control_point(i, j), w).finished();
      for (int d = 0; d <= order; ++d) row.col(d) += nv[d * (q + 1) + b] * point;
    }
    jet.col(0) += nu[a] * row.col(0);
    if (order < 1) continue;
    jet.col(1) += nu[p + 1 + a] * row.col(0);
    jet.col(2) += nu[a] * row.col(1);
    if (order < 2) continue;
    jet.col(3) += nu[2 * (p + 1) + a] * row.col(0);
    jet.col(4) += nu[p + 1 + a] * row.col(1);
    jet.col(5) += nu[a] * row.col(2);
  }
  return jet;
}

void CheckAndClosePeriodic(const BSplineBasis& u, const BSplineBasis& v, std::vector<Eigen::Vector3d>& points,
                           std::vector<double>& weights) {
  const auto close = [&](std::size_t repeated, std::size_t original, double tolerance) {
    if ((points[repeated] - points[original]).norm() > tolerance ||
        std::abs(weights[repeated] - weights[original]) > 1e-9 * weights[original]) {
      throw InputError("a periodic direction's last control points do not repeat its first ones");
    }
    points[repeated] = points[original];
    weights[repeated] = weights[original];
  };
  double extent = 0;
  for (const auto& point : points) extent = std::max(extent, (point - points[0]).norm());
  const auto nu = static_cast<std::size_t>(u.num_control_points());
  const auto nv = static_cast<std::size_t>(v.num_control_points());
  const auto distinct_u = static_cast<std::size_t>(u.num_distinct_control_points());
  const auto distinct_v = static_cast<std::size_t>(v.num_distinct_control_points());
  for (std::size_t i = 0; i < nu; ++i) {
    for (std::size_t j = distinct_v; j < nv; ++j) close(i * nv + j, i * nv + j - distinct_v, 1e-9 * extent);
  }
  for (std::size_t i = distinct_u; i < nu; ++i) {
    for (std::size_t j = 0; j < nv; ++j) close(i * nv + j, (i - distinct_u) * nv + j, 1e-9 * extent);
  }
}

}  // namespace

Eigen::Vector3d SurfacePoint::Normal() const {
  const Eigen::Vector3d cross = du.cross(dv);
  const double length = cross.norm(), length_u = du.norm(), length_v = dv.norm();
  // At a collapsed edge S_u is not 0 but rounding, to be told by the size of the other derivatives.
  const double rounding = 1e-13 * std::max({length_u, length_v, duu.norm(), duv.norm(), dvv.norm()});
  const bool exists = length > 1e-14 * length_u * length_v && std::min(length_u, length_v) > rounding;
  return exists ? Eigen::Vector3d(cross / length) : Eigen::Vector3d::Zero();
}

NurbsSurface::NurbsSurface(BSplineBasis u, BSplineBasis v, std::vector<Eigen::Vector3d> control_points,
                           std::vector<double> weights)
    : u_(std::move(u)),
      v_(std::move(v)),
      control_points_(std::move(control_points)),
      weights_(std::move(weights)) {
  const std::size_t expected = static_cast<std::size_t>(count_u()) * static_cast<std::size_t>(count_v());
  if (weights_.empty()) weights_.assign(expected, 1.0);
  if (control_points_.size() != expected || weights_.size() != expected) {
    throw InputError("the knot vectors ask for " + std::to_string(count_u()) + " x " +
                     std::to_string(count_v()) + " control points and weights, not " +
                     std::to_string(control_points_.size()) + " and " + std::to_string(weights_.size()));
  }
  for (std::size_t k = 0; k < expected; ++k) {
    if (!control_points_[k].allFinite())
      throw InputError("control point " + std::to_string(k) + " is not finite");
    if (!(weights_[k] > 0) || !std::isfinite(weights_[k])) {
      throw InputError("weight " + std::to_string(k) + " is not a positive number");
    }
  }
  CheckAndClosePeriodic(u_, v_, control_points_, weights_);
}

bool NurbsSurface::IsRational() const {
  for (const double w : weights_) {
    if (w != weights_[0]) return true;
  }
  return false;
}

Eigen::Vector3d NurbsSurface::Evaluate(double u, double v) const {
  const Eigen::Vector4d h = EvaluateHomogeneous(*this, u_.IntoDomain(u), v_.IntoDomain(v), 0).col(0);
  return h.head<3>() / h[3];
}

SurfacePoint NurbsSurface::EvaluateWithDerivatives(double u, double v) const {
  const HomogeneousJet jet = EvaluateHomogeneous(*this, u_.IntoDomain(u), v_.IntoDomain(v), 2);
  const auto w = jet.row(3);
  SurfacePoint s;  // The NURBS Book, eq. (4.20)
  s.position = jet.col(0).head<3>() / w[0];
  s.du = (jet.col(1).head<3>() - w[1] * s.position) / w[0];
  s.dv = (jet.col(2).head<3>() - w[2] * s.position) / w[0];
  s.duu = (jet.col(3).head<3>() - 2 * w[1] * s.du - w[3] * s.position) / w[0];
  s.duv = (jet.col(4).head<3>() - w[1] * s.dv - w[2] * s.du - w[4] * s.position) / w[0];
  s.dvv = (jet.col(5).head<3>() - 2 * w[2] * s.dv - w[5] * s.position) / w[0];
  return s;
}

double NurbsSurface::Size() const {
  Eigen::Vector3d low = control_points_[0], high = low;
  for (const auto& point : control_points_) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

std::vector<double> TrimCrossings(const std::vector<TrimLoop>& trim, double u) {
  std::vector<double> crossings;
  for (const TrimLoop& loop : trim) {
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Eigen::Vector2d &a = loop[i], &b = loop[j];
      if ((a.x() > u) != (b.x() > u)) {
        crossings.push_back(a.y() + (b.y() - a.y()) * (u - a.x()) / (b.x() - a.x()));
      }
    }
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

bool InsideTrim(const std::vector<TrimLoop>& trim, const Eigen::Vector2d& uv) {
  if (trim.empty()) return true;
  const std::vector<double> crossings = TrimCrossings(trim, uv.x());
  return (std::lower_bound(crossings.begin(), crossings.end(), uv.y()) - crossings.begin()) % 2 == 1;
}

}  // namespace frond
