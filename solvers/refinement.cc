// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/refinement.h"

#include <ceres/crs_matrix.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <vector>

namespace frond {
namespace {

constexpr int kMostSteps = 30;
constexpr double kShorter = 0.9;  // a step over the one before
constexpr double kNear = 1e-3;    // |D δ| over |D x| where refinement begins
constexpr double kCostRounding = 1e-9;

// Cost, residuals and Jacobian over the free blocks at the current x.
struct Linearisation {
  double cost = 0;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

bool Linearise(ceres::Problem* problem, const std::vector<double*>& free_blocks, Linearisation* out) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = free_blocks;
  std::vector<double> residuals;
  ceres::CRSMatrix sparse;
  if (!problem->Evaluate(options, &out->cost, &residuals, nullptr, &sparse)) return false;
  out->residuals = Eigen::VectorXd::Map(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
  out->jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int k = sparse.rows[static_cast<std::size_t>(row)];
         k < sparse.rows[static_cast<std::size_t>(row) + 1]; ++k) {
      out->jacobian(row, sparse.cols[static_cast<std::size_t>(k)]) =
          sparse.values[static_cast<std::size_t>(k)];
    }
  }
  return true;
}

}  // namespace

std::optional<double> RefineByGaussNewton(double best_cost, LeastSquares* least_squares) {
  ceres::Problem& problem = least_squares->problem();
  std::vector<double*> all_blocks, free_blocks;
  problem.GetParameterBlocks(&all_blocks);
  std::vector<double*> values;  // of the free blocks, one by one
  for (double* block : all_blocks) {
    if (problem.IsParameterBlockConstant(block)) continue;
    free_blocks.push_back(block);
    for (int i = 0; i < problem.ParameterBlockSize(block); ++i) values.push_back(block + i);
  }
  const std::vector<double> start(least_squares->x().begin(), least_squares->x().end());
  const auto size = static_cast<Eigen::Index>(values.size());
  double last_length = std::numeric_limits<double>::infinity();
  Linearisation at;
  bool moved = false, cost_known = false;  // at.cost is that of x
  for (int step = 0; step < kMostSteps && Linearise(&problem, free_blocks, &at); ++step) {
    cost_known = true;
    const Eigen::VectorXd scale = at.jacobian.colwise().norm();
    const Eigen::VectorXd delta = -at.jacobian.colPivHouseholderQr().solve(at.residuals);
    Eigen::VectorXd x(size);
    for (Eigen::Index i = 0; i < size; ++i) x[i] = *values[static_cast<std::size_t>(i)];
    const double length = scale.cwiseProduct(delta).norm();
    if (step == 0 && !(length <= kNear * scale.cwiseProduct(x).norm())) break;
    if (!(length < kShorter * last_length) || length == 0) break;
    last_length = length;
    for (Eigen::Index i = 0; i < size; ++i) *values[static_cast<std::size_t>(i)] += delta[i];
    moved = true;
    cost_known = false;
  }
  if (!moved) return std::nullopt;
  const double cost = cost_known ? at.cost : least_squares->Cost();
  if (!std::isfinite(cost) || !(cost <= best_cost * (1 + kCostRounding))) {
    least_squares->SetX(start);
    return std::nullopt;
  }
  return cost;
}

}  // namespace frond
