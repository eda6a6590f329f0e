// SPDX-License-Identifier: BSD-3-Clause
#include "models/surface_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frond {

SpanPolynomials::SpanPolynomials(const BSplineBasis& basis)
    : degree_(basis.degree()), domain_begin_(basis.begin()) {
  const int p = degree_;
  std::vector<double> derivatives(static_cast<std::size_t>((p + 1) * (p + 1)));
  for (const int s : basis.spans()) {
    const double begin = basis.knots()[static_cast<std::size_t>(s)];
    const double length = basis.knots()[static_cast<std::size_t>(s) + 1] - begin;
    basis.Evaluate(s, begin, p, derivatives.data());
    Eigen::MatrixXd c(p + 1, p + 1);  // Taylor series at the span's begin
    double scale = 1;
    for (int m = 0; m <= p; ++m) {
      for (int a = 0; a <= p; ++a) c(a, m) = derivatives[static_cast<std::size_t>(m * (p + 1) + a)] * scale;
      scale *= length / (m + 1);
    }
    first_.push_back(s - p);
    begin_.push_back(begin);
    length_.push_back(length);
    coefficients_.push_back(std::move(c));
  }
  // A table to find spans in constant time: starting there, at most a few steps are left on uneven knots.
  const std::size_t parts = 4 * begin_.size();
  cells_per_unit_ = static_cast<double>(parts) / (basis.end() - basis.begin());
  int span = 0;
  for (std::size_t i = 0; i < parts; ++i) {
    const double t = domain_begin_ + static_cast<double>(i) / cells_per_unit_;
    while (span + 1 < count() && begin_[static_cast<std::size_t>(span) + 1] <= t) ++span;
    lookup_.push_back(span);
  }
}

int SpanPolynomials::SpanOf(double t) const {
  const auto part = static_cast<long>((t - domain_begin_) * cells_per_unit_);
  auto k = static_cast<std::size_t>(
      lookup_[static_cast<std::size_t>(std::clamp<long>(part, 0, static_cast<long>(lookup_.size()) - 1))]);
  while (k + 1 < begin_.size() && begin_[k + 1] <= t) ++k;
  while (k > 0 && begin_[k] > t) --k;
  return static_cast<int>(k);
}

void SpanPolynomials::Evaluate(int k, double t, int order, double* out) const {
  const Eigen::MatrixXd& c = coefficients(k);
  const double inverse = 1 / length(k), s = (t - begin(k)) * inverse;
  const int p = degree_;
  for (int a = 0; a <= p; ++a) {
    double f = 0, d1 = 0, d2 = 0;
    for (int m = p; m >= 0; --m) {
      d2 = d2 * s + 2 * d1;
      d1 = d1 * s + f;
      f = f * s + c(a, m);
    }
    out[a] = f;
    if (order > 0) out[p + 1 + a] = d1 * inverse;
    if (order > 1) out[2 * (p + 1) + a] = d2 * inverse * inverse;
  }
}

SurfaceCells::SurfaceCells(const NurbsSurface& surface)
    : basis_u_(surface.u()), basis_v_(surface.v()), u_(basis_u_), v_(basis_v_) {
  coefficients_.resize(static_cast<std::size_t>(count() * (u_.degree() + 1) * (v_.degree() + 1)));
  Update(surface.control_points(), surface.weights());
}

void SurfaceCells::Update(std::span<const Eigen::Vector3d> control_points, std::span<const double> weights) {
  rational_ = std::any_of(weights.begin(), weights.end(), [&](double w) { return w != weights[0]; });
  const int p = u_.degree(), q = v_.degree();
  const auto nv = static_cast<std::size_t>(basis_v_.num_control_points());
  const auto is_pole = [&](std::size_t j) {
    if (!basis_u_.periodic() || basis_v_.periodic()) return false;
    for (std::size_t k = j; k < control_points.size(); k += nv) {
      if (control_points[k] != control_points[j]) return false;
    }
    return true;
  };
  poles_ = {is_pole(0), is_pole(nv - 1)};
  Eigen::Array4d* out = coefficients_.data();
  std::array<Eigen::Array4d, (kMaxDegree + 1) * (kMaxDegree + 1)> half;  // power of s × control column
  for (int ku = 0; ku < u_.count(); ++ku) {
    const Eigen::MatrixXd& cu = u_.coefficients(ku);
    for (int kv = 0; kv < v_.count(); ++kv) {
      const Eigen::MatrixXd& cv = v_.coefficients(kv);
      for (int b = 0; b <= q; ++b) {
        for (int m = 0; m <= p; ++m) half[static_cast<std::size_t>(m * (q + 1) + b)].setZero();
        for (int a = 0; a <= p; ++a) {
          const std::size_t k =
              static_cast<std::size_t>(u_.first(ku) + a) * nv + static_cast<std::size_t>(v_.first(kv) + b);
          const double w = rational_ ? weights[k] : 1.0;
          const Eigen::Array4d point(w * control_points[k].x(), w * control_points[k].y(),
                                     w * control_points[k].z(), w);
          for (int m = 0; m <= p; ++m) half[static_cast<std::size_t>(m * (q + 1) + b)] += cu(a, m) * point;
        }
      }
      for (int m = 0; m <= p; ++m) {
        for (int n = 0; n <= q; ++n, ++out) {
          out->setZero();
          for (int b = 0; b <= q; ++b) *out += cv(b, n) * half[static_cast<std::size_t>(m * (q + 1) + b)];
        }
      }
    }
  }
}

// out: S, then S_u, S_v, then S_uu, S_uv, S_vv of the homogeneous surface, in the true parameters.
// kDegree is the degree in both directions where known at compile time, −1 otherwise.
template <int kDegree, int kOrder>
inline void SurfaceCells::Horner(double u, double v, Eigen::Array4d* out) const {
  const int ku = u_.SpanOf(u), kv = v_.SpanOf(v);
  const int p = kDegree > 0 ? kDegree : u_.degree(), q = kDegree > 0 ? kDegree : v_.degree();
  const double iu = 1 / u_.length(ku), iv = 1 / v_.length(kv);
  const double s = (u - u_.begin(ku)) * iu, t = (v - v_.begin(kv)) * iv;
  const Eigen::Array4d* c = coefficients_.data() + (ku * v_.count() + kv) * (p + 1) * (q + 1);
  Eigen::Array4d f = Eigen::Array4d::Zero(), fu = f, fv = f, fuu = f, fuv = f, fvv = f;
  for (int m = p; m >= 0; --m) {
    const Eigen::Array4d* row = c + m * (q + 1);
    Eigen::Array4d g = row[q], gv = Eigen::Array4d::Zero(), gvv = gv;
    for (int n = q - 1; n >= 0; --n) {
      if constexpr (kOrder > 1) gvv = gvv * t + 2 * gv;
      if constexpr (kOrder > 0) gv = gv * t + g;
      g = g * t + row[n];
    }
    if constexpr (kOrder > 1) {
      fuu = fuu * s + 2 * fu;
      fuv = fuv * s + fv;
      fvv = fvv * s + gvv;
    }
    if constexpr (kOrder > 0) {
      fu = fu * s + f;
      fv = fv * s + gv;
    }
    f = f * s + g;
  }
  out[0] = f;
  if constexpr (kOrder > 0) {
    out[1] = fu * iu;
    out[2] = fv * iv;
  }
  if constexpr (kOrder > 1) {
    out[3] = fuu * (iu * iu);
    out[4] = fuv * (iu * iv);
    out[5] = fvv * (iv * iv);
  }
}

template <int kOrder>
inline void SurfaceCells::HomogeneousJet(double u, double v, Eigen::Array4d* out) const {
  if (u_.degree() == 3 && v_.degree() == 3) return Horner<3, kOrder>(u, v, out);
  if (u_.degree() == 2 && v_.degree() == 2) return Horner<2, kOrder>(u, v, out);
  Horner<-1, kOrder>(u, v, out);
}

Eigen::Vector3d SurfaceCells::Evaluate(double u, double v) const {
  Eigen::Array4d h[1];
  HomogeneousJet<0>(u, v, h);
  return (rational_ ? Eigen::Array4d(h[0] / h[0][3]) : h[0]).head<3>().matrix();
}

SurfaceCells::Jet1 SurfaceCells::Evaluate1(double u, double v) const {
  Eigen::Array4d h[3];
  HomogeneousJet<1>(u, v, h);
  Jet1 jet{h[0].head<3>().matrix(), h[1].head<3>().matrix(), h[2].head<3>().matrix()};
  if (rational_) {
    const double inverse = 1 / h[0][3];
    jet.position *= inverse;
    jet.du = (jet.du - h[1][3] * jet.position) * inverse;
    jet.dv = (jet.dv - h[2][3] * jet.position) * inverse;
  }
  return jet;
}

SurfaceCells::Jet2 SurfaceCells::Evaluate2(double u, double v) const {
  Eigen::Array4d h[6];
  HomogeneousJet<2>(u, v, h);
  Jet2 jet;
  jet.position = h[0].head<3>().matrix();
  jet.du = h[1].head<3>().matrix();
  jet.dv = h[2].head<3>().matrix();
  jet.duu = h[3].head<3>().matrix();
  jet.duv = h[4].head<3>().matrix();
  jet.dvv = h[5].head<3>().matrix();
  if (rational_) {  // The NURBS Book, eq. (4.20)
    const double inverse = 1 / h[0][3];
    jet.position *= inverse;
    jet.du = (jet.du - h[1][3] * jet.position) * inverse;
    jet.dv = (jet.dv - h[2][3] * jet.position) * inverse;
    jet.duu = (jet.duu - 2 * h[1][3] * jet.du - h[3][3] * jet.position) * inverse;
    jet.duv = (jet.duv - h[1][3] * jet.dv - h[2][3] * jet.du - h[4][3] * jet.position) * inverse;
    jet.dvv = (jet.dvv - 2 * h[2][3] * jet.dv - h[5][3] * jet.position) * inverse;
  }
  return jet;
}

double SurfaceCells::Denominator(double u, double v) const {
  Eigen::Array4d h[1];
  HomogeneousJet<0>(u, v, h);
  return rational_ ? h[0][3] : 1.0;
}

}  // namespace frond
