// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/parameter_covariance.h"

#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>

#include <Eigen/Eigenvalues>
#include <string>
#include <vector>

#include "base/errors.h"
#include "solvers/quiet_ceres_log.h"

namespace frond {
namespace {

// Of JᵀJ with unit diagonal; below it the smallest eigenvalue is rounding.
constexpr double kSmallestEigenvalue = 1e-12;

[[noreturn]] void FailUndetermined(const std::string& block) {
  throw FitError("the data do not determine '" + block + "': hold it, or give more views");
}

Eigen::MatrixXd Dense(const ceres::CRSMatrix& sparse) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int i = 0; i < sparse.num_rows; ++i) {
    for (int k = sparse.rows[static_cast<std::size_t>(i)]; k < sparse.rows[static_cast<std::size_t>(i) + 1];
         ++k) {
      dense(i, sparse.cols[static_cast<std::size_t>(k)]) += sparse.values[static_cast<std::size_t>(k)];
    }
  }
  return dense;
}

// (JᵀJ)⁻¹ through the eigenvalues of JᵀJ scaled to a unit diagonal, since units differ. `owners` names the
// block of each column.
Eigen::MatrixXd InverseGram(const Eigen::MatrixXd& J, const std::vector<std::string>& owners) {
  const Eigen::VectorXd norms = J.colwise().norm();
  for (Eigen::Index k = 0; k < norms.size(); ++k) {
    if (!(norms[k] > 0)) FailUndetermined(owners[static_cast<std::size_t>(k)]);
  }
  const Eigen::MatrixXd scaled = J * norms.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  if (!(eigen.eigenvalues()[0] > kSmallestEigenvalue)) {
    Eigen::Index weakest = 0;
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&weakest);
    FailUndetermined(owners[static_cast<std::size_t>(weakest)]);
  }
  const Eigen::MatrixXd inverse = eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                  eigen.eigenvectors().transpose();
  return norms.cwiseInverse().asDiagonal() * inverse * norms.cwiseInverse().asDiagonal();
}

}  // namespace

Eigen::MatrixXd UnitCovariance(const FitProblem& fit, std::span<const double> x) {
  LeastSquares least_squares(fit, 1);
  least_squares.SetX(x);
  ceres::Problem& problem = least_squares.problem();

  // All values from the tangent of the free ones: ambient = plus · tangent.
  ceres::Problem::EvaluateOptions options;
  std::vector<std::string> owners;
  std::vector<Eigen::MatrixXd> plus_of_block;
  std::vector<Eigen::Index> first_value;
  Eigen::Index first = 0;
  for (const ParameterBlock& block : fit.parameters()) {
    double* const values = least_squares.x().data() + first;
    const auto size = static_cast<Eigen::Index>(block.start.size());
    if (!block.constant) {
      const int tangent = problem.ParameterBlockTangentSize(values);
      Eigen::MatrixXd plus = Eigen::MatrixXd::Identity(size, size);
      if (block.manifold != nullptr) {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(size, tangent);
        block.manifold->PlusJacobian(values, jacobian.data());
        plus = jacobian;
      }
      options.parameter_blocks.push_back(values);
      owners.insert(owners.end(), static_cast<std::size_t>(tangent), block.name);
      plus_of_block.push_back(plus);
      first_value.push_back(first);
    }
    first += size;
  }
  ceres::CRSMatrix sparse;
  const QuietCeresLog quiet;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &sparse)) {
    throw FitError("the residuals cannot be evaluated at the solution");
  }
  const Eigen::MatrixXd J = Dense(sparse);
  Eigen::MatrixXd plus = Eigen::MatrixXd::Zero(first, J.cols());
  Eigen::Index column = 0;
  for (std::size_t b = 0; b < plus_of_block.size(); ++b) {
    const Eigen::MatrixXd& block = plus_of_block[b];
    plus.block(first_value[b], column, block.rows(), block.cols()) = block;
    column += block.cols();
  }
  return plus * InverseGram(J, owners) * plus.transpose();
}

}  // namespace frond
