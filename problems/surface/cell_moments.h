// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace frond {

// The normal equations of many rows of the form c ⊗ B(s, t) over the (p + 1)(q + 1) control points of one
// knot cell, where B_k(s, t) = N_a(s) N_b(t), k = a (q + 1) + b, and c has `components` entries (3, or 4 in
// homogeneous coordinates). Every row of a distance fit has this form (MATH.md §1), so
//
//   H = Σ (c cᵀ) ⊗ (B Bᵀ),   g = Σ (c r) ⊗ B
//
// need only the moments Σ (c cᵀ) (s − ½)^m (t − ½)^n, m ≤ 2p, n ≤ 2q: for a bicubic cell 294 multiply–adds a
// point where the matrix itself takes 1,176, and as many again to turn the cell's moments into H once. About
// the cell's middle, because (1 − s)^p in powers of s loses 2^p to cancellation, and H its square in each
// direction.
class CellMoments {
 public:
  // `right_hand_sides`: values of c r; more than `components` where scalar rows fit several coordinates at
  // once.
  CellMoments(int degree_u, int degree_v, int components, int right_hand_sides);

  void Reset();

  // s, t in [0, 1]. `matrix`: the lower triangle of Σ c cᵀ over the point's rows, row by row
  // (components (components + 1) / 2 values); `vector`: Σ c r (right_hand_sides values).
  void Add(double s, double t, const double* matrix, const double* vector);

  // Adds H (index k * components + component, full and symmetric) to h, and g (k * right_hand_sides + …) to
  // g. The coefficients (function × power) of the cell's functions are in s and t, as
  // SpanPolynomials::coefficients.
  void AddTo(const Eigen::MatrixXd& coefficients_u, const Eigen::MatrixXd& coefficients_v, Eigen::MatrixXd* h,
             Eigen::VectorXd* g) const;

 private:
  int p_, q_, components_, right_hand_sides_, entries_, columns_;
  std::vector<double>
      matrix_;  // entry, power of s − ½ (2p + 1), of t − ½ (2q + 1, padded to a multiple of 4)
  std::vector<double> vector_;  // right-hand side, power of s − ½ (p + 1), of t − ½ (q + 1)
};

}  // namespace frond
