// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

// The functions of one direction as polynomials, span by span: on span k, with the local parameter
// s = (t − begin_k) / length_k in [0, 1], N_{first_k + a}(t) = Σ_m coefficient(k)(a, m) s^m.
class SpanPolynomials {
 public:
  explicit SpanPolynomials(const BSplineBasis& basis);

  int degree() const { return degree_; }
  int count() const { return static_cast<int>(begin_.size()); }
  int first(int k) const { return first_[static_cast<std::size_t>(k)]; }  // index of the first function
  double begin(int k) const { return begin_[static_cast<std::size_t>(k)]; }
  double length(int k) const { return length_[static_cast<std::size_t>(k)]; }
  const Eigen::MatrixXd& coefficients(int k) const { return coefficients_[static_cast<std::size_t>(k)]; }
  int SpanOf(double t) const;  // the span that holds t, t in the domain

  // Values and derivatives in t up to `order` (≤ 2) of the degree + 1 functions at t; as
  // BSplineBasis::Evaluate.
  void Evaluate(int k, double t, int order, double* out) const;

 private:
  int degree_;
  double domain_begin_, cells_per_unit_;
  std::vector<int> first_;
  std::vector<double> begin_, length_;
  std::vector<Eigen::MatrixXd> coefficients_;
  std::vector<int> lookup_;  // span of the start of each of `lookup_.size()` equal parts of the domain
};

// A surface as one bivariate polynomial (in homogeneous coordinates where rational) for each non-empty knot
// cell, evaluated by Horner's rule: the fast path for many points. Cell index: k_u * count_v + k_v.
class SurfaceCells {
 public:
  struct Jet1 {
    Eigen::Vector3d position, du, dv;
  };
  struct Jet2 : Jet1 {
    Eigen::Vector3d duu, duv, dvv;
  };

  explicit SurfaceCells(const NurbsSurface& surface);

  // New control points and weights (all counts as before), for example at each iterate of a fit.
  void Update(std::span<const Eigen::Vector3d> control_points, std::span<const double> weights);

  const BSplineBasis& basis_u() const { return basis_u_; }
  const BSplineBasis& basis_v() const { return basis_v_; }
  const SpanPolynomials& u() const { return u_; }
  const SpanPolynomials& v() const { return v_; }
  int count() const { return u_.count() * v_.count(); }
  bool rational() const { return rational_; }
  const PoleEnds& poles() const { return poles_; }  // of the present control points
  int CellOf(double u, double v) const { return u_.SpanOf(u) * v_.count() + v_.SpanOf(v); }

  // (u, v) in the domain. Without allocation; re-entrant.
  Eigen::Vector3d Evaluate(double u, double v) const;
  Jet1 Evaluate1(double u, double v) const;
  Jet2 Evaluate2(double u, double v) const;
  double Denominator(double u, double v) const;  // Σ N_i N_j w_ij

 private:
  template <int kDegree, int kOrder>
  void Horner(double u, double v, Eigen::Array4d* out) const;
  template <int kOrder>
  void HomogeneousJet(double u, double v, Eigen::Array4d* out) const;

  BSplineBasis basis_u_, basis_v_;
  SpanPolynomials u_, v_;
  bool rational_ = false;
  PoleEnds poles_;
  std::vector<Eigen::Array4d> coefficients_;  // cell-major, then power of s (u), then power of t (v)
};

}  // namespace frond
