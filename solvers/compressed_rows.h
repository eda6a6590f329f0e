// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "solvers/robust_loss.h"

namespace frond {

// Many rows over the same D parameters, A (m × D) and r (m), as D + 1 rows with the same cost, gradient and
// Gauss–Newton matrix (MATH.md §1). With H = AᵀA ≈ LLᵀ and g = Aᵀr:
//
//   residual = [ L⁻¹g ; √(rᵀr − |L⁻¹g|²) ],   Jacobian = [ Lᵀ ; 0 ]
struct CompressedBlock {
  // Lᵀ, D × D, zero below the diagonal. Row-major, as Ceres wants its Jacobians.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  Eigen::VectorXd residual;  // D + 1
  double squared_norm = 0;   // rᵀr, or Σ ρ(r²)
  bool factored = false;     // jacobian and residual belong to squared_norm's parameters
};

// Fills `block` from normal equations; of H the upper triangle is read. H may be singular: 1e-13 of each
// diagonal entry is added to it (relative to the entry itself, not to the mean diagonal, so that parameters
// of very different units keep their curvature), more only if rounding left H indefinite beyond that. The
// gradient JᵀR = g is kept to rounding whatever was added. False, and block->factored false, where a value is
// not finite.
bool FactorNormalEquations(const Eigen::Ref<const Eigen::MatrixXd>& H,
                           const Eigen::Ref<const Eigen::VectorXd>& g, double squared_norm,
                           CompressedBlock* block);

// The cost alone, for an evaluation without Jacobians: needs no factor.
inline void SetCostOnly(double squared_norm, CompressedBlock* block) {
  block->squared_norm = squared_norm;
  block->factored = false;
}

// Accumulates H = AᵀWA (upper triangle), g = AᵀWr and rᵀWr row by row. All memory is taken by the
// constructor.
class CompressedRows {
 public:
  explicit CompressedRows(int num_parameters);

  void Reset();
  int num_parameters() const { return static_cast<int>(g_.size()); }

  // One row ∂r/∂parameters (D values) with its residual and weight ≥ 0 (weight w counts as w rows).
  void AddRow(std::span<const double> jacobian_row, double residual, double weight = 1) {
    AddWeightedRow(jacobian_row, residual, weight, weight * residual * residual);
  }

  // One row with a robust loss, as Ceres applies it: ρ in the cost, √ρ′ on residual and Jacobian.
  void AddRow(std::span<const double> jacobian_row, double residual, const RobustLoss& loss) {
    const RobustLoss::Value value = loss(residual * residual);
    AddWeightedRow(jacobian_row, residual, value.derivative, value.rho);
  }

  // A row with everything given: H += w aaᵀ, g += w a r, rᵀr += cost.
  void AddWeightedRow(std::span<const double> jacobian_row, double residual, double weight, double cost) {
    const Eigen::Map<const Eigen::VectorXd> a(jacobian_row.data(), g_.size());
    for (Eigen::Index j = 0; j < a.size(); ++j) {
      const double scaled = weight * a[j];
      if (scaled == 0) continue;
      H_.col(j).head(j + 1).noalias() += scaled * a.head(j + 1);
      g_[j] += scaled * residual;
    }
    squared_norm_ += cost;
  }

  // Rows accumulated elsewhere, for example a fairness term's Gram matrix. The upper triangle of H is read.
  void AddMatrix(const Eigen::Ref<const Eigen::MatrixXd>& H, const Eigen::Ref<const Eigen::VectorXd>& g,
                 double squared_norm);

  // For an evaluation without Jacobians.
  void AddCost(double cost) { squared_norm_ += cost; }

  // Direct access for callers that form the products themselves; only the upper triangle of H is used.
  Eigen::MatrixXd& H() { return H_; }
  Eigen::VectorXd& g() { return g_; }
  double& squared_norm() { return squared_norm_; }
  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::VectorXd& g() const { return g_; }
  double squared_norm() const { return squared_norm_; }

  bool Compress(CompressedBlock* block) const { return FactorNormalEquations(H_, g_, squared_norm_, block); }

 private:
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
  double squared_norm_ = 0;
};

}  // namespace frond
