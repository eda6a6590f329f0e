// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/compressed_rows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace frond {
namespace {

// Added to the unit diagonal of the scaled H: above the rounding of sums and factor, below what a
// Gauss–Newton step can feel. Raised by kJitterGrowth while the factor fails, up to kLargestJitter.
constexpr double kJitter = 1e-13;
constexpr double kJitterGrowth = 10;
constexpr double kLargestJitter = 1e-8;

}  // namespace

bool FactorNormalEquations(const Eigen::Ref<const Eigen::MatrixXd>& H,
                           const Eigen::Ref<const Eigen::VectorXd>& g, double squared_norm,
                           CompressedBlock* block) {
  const Eigen::Index size = g.size();
  SetCostOnly(squared_norm, block);
  if (!std::isfinite(squared_norm) || !g.allFinite()) return false;

  // H = S C S with S = diag(√H_ii), C of unit diagonal. A parameter without rows has a zero in S and keeps a
  // zero column in the Jacobian.
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(0).cwiseSqrt();
  if (!scale.allFinite()) return false;
  const Eigen::VectorXd inverse = scale.unaryExpr([](double s) { return s > 0 ? 1 / s : 0.0; });
  const Eigen::MatrixXd C =
      inverse.asDiagonal() * H.triangularView<Eigen::Upper>().toDenseMatrix() * inverse.asDiagonal();

  Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> factor(size);
  for (double jitter = kJitter; jitter <= kLargestJitter; jitter *= kJitterGrowth) {
    Eigen::MatrixXd regular = C;
    for (Eigen::Index i = 0; i < size; ++i) regular(i, i) = (scale[i] > 0 ? 1 : 0) + jitter;
    factor.compute(regular);
    if (factor.info() == Eigen::Success) break;
  }
  if (factor.info() != Eigen::Success) return false;

  block->jacobian = factor.matrixU().toDenseMatrix() * scale.asDiagonal();
  block->residual.resize(size + 1);
  block->residual.head(size) = factor.matrixL().solve(inverse.cwiseProduct(g));
  const double explained = block->residual.head(size).squaredNorm();
  block->residual[size] = std::sqrt(std::max(0.0, squared_norm - explained));
  block->factored = block->jacobian.allFinite() && block->residual.allFinite();
  return block->factored;
}

CompressedRows::CompressedRows(int num_parameters)
    : H_(Eigen::MatrixXd::Zero(num_parameters, num_parameters)), g_(Eigen::VectorXd::Zero(num_parameters)) {}

void CompressedRows::Reset() {
  H_.setZero();
  g_.setZero();
  squared_norm_ = 0;
}

void CompressedRows::AddMatrix(const Eigen::Ref<const Eigen::MatrixXd>& H,
                               const Eigen::Ref<const Eigen::VectorXd>& g, double squared_norm) {
  H_.triangularView<Eigen::Upper>() += H;
  g_ += g;
  squared_norm_ += squared_norm;
}

}  // namespace frond
