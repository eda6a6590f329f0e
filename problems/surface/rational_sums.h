// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace frond {

// The normal equations of the homogeneous system (25) of the acquisition paper,
//
//   N P_x − Q_x N w = 0,   N P_y − Q_y N w = 0,   N P_z − Q_z N w = 0,
//
// for n functions b (curve or surface alike), N the rows b(s_i)ᵀ at the points' fixed parameters, Q_x the
// diagonal of their coordinates. P are the weighted control points w_k P_k. All n × n, symmetric.
struct RationalSums {
  explicit RationalSums(Eigen::Index functions);

  Eigen::MatrixXd gram;                   // NᵀN
  std::array<Eigen::MatrixXd, 3> moment;  // NᵀQ_xN, NᵀQ_yN, NᵀQ_zN
  Eigen::MatrixXd square;                 // Nᵀ(Q_x² + Q_y² + Q_z²)N
};

struct RationalSolution {
  Eigen::VectorXd weights;  // of mean 1
  Eigen::MatrixXd points;   // n × 3, the control points themselves
  double quotient = 0;      // wᵀMw / wᵀw
  bool bounded = false;     // the smallest eigenvector was not positive
};

// The least weight allowed, as a share of the mean one.
inline constexpr double kLeastWeight = 0.05;

// Ma's two steps (eq. 26). The control points are eliminated, which leaves M w = 0 with
//
//   M = Nᵀ(Q_x² + Q_y² + Q_z²)N − Σ_c (NᵀQ_cN)(NᵀN)⁻¹(NᵀQ_cN),   symmetric, non-negative;
//
// the weights minimise the Rayleigh quotient wᵀMw / wᵀw: the eigenvector of the smallest eigenvalue where it
// is positive. Where several eigenvalues vanish (the points lie on a surface of lower degree) it is the
// vector of that space nearest to equal weights. Otherwise the quotient is minimised subject to w_k ≥
// kLeastWeight · mean. Then the control points follow from the linear system. Throws FitError where NᵀN is
// singular: too few points for the functions.
RationalSolution SolveRationalSums(const RationalSums& sums);

// Minimises wᵀMw / wᵀw over the cone w_k ≥ kLeastWeight · mean(w), M symmetric and non-negative, from equal
// weights: inverse iteration in which each linear solve is a quadratic programme over the cone. The quotient
// falls in every step. Of unit length.
Eigen::VectorXd BoundedRayleighMinimum(const Eigen::MatrixXd& matrix);

}  // namespace frond
