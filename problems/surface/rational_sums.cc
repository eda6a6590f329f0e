// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/rational_sums.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "base/errors.h"

namespace frond {
namespace {

constexpr double kNullSpace = 1e-12;  // eigenvalues up to this share of the largest count as zero

// min ½ zᵀHz − cᵀz subject to z ≥ 0, H positive definite, by a primal active set from a feasible z.
Eigen::VectorXd NonNegativeMinimum(const Eigen::MatrixXd& h, const Eigen::VectorXd& c, Eigen::VectorXd z) {
  const Eigen::Index n = z.size();
  std::vector<Eigen::Index> passive;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (z[k] > 0) passive.push_back(k);
  }
  const double tolerance = 1e-9 * c.cwiseAbs().maxCoeff();
  for (Eigen::Index step = 0; step < 10 * n; ++step) {
    const Eigen::VectorXd solved = h(passive, passive).llt().solve(c(passive));
    double reach = 1;
    for (std::size_t k = 0; k < passive.size(); ++k) {
      const double to = solved[static_cast<Eigen::Index>(k)], from = z[passive[k]];
      if (to <= 0) reach = std::min(reach, from / (from - to));
    }
    std::vector<Eigen::Index> kept;
    for (std::size_t k = 0; k < passive.size(); ++k) {
      const double to = solved[static_cast<Eigen::Index>(k)];
      double& value = z[passive[k]];
      const bool leaves = to <= 0 && value / (value - to) <= reach * (1 + 1e-12);
      value = leaves ? 0 : value + reach * (to - value);
      if (!leaves) kept.push_back(passive[k]);
    }
    const bool blocked = kept.size() < passive.size();
    passive = std::move(kept);
    if (blocked) continue;
    const Eigen::VectorXd descent = c - h * z;
    Eigen::Index best = -1;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (z[k] == 0 && descent[k] > tolerance && (best < 0 || descent[k] > descent[best])) best = k;
    }
    if (best < 0) break;
    passive.insert(std::lower_bound(passive.begin(), passive.end(), best), best);
  }
  return z;
}

bool IsPositive(const Eigen::VectorXd& weights) {
  return weights.minCoeff() >= kLeastWeight * weights.mean() && weights.mean() > 0;
}

}  // namespace

RationalSums::RationalSums(Eigen::Index functions)
    : gram(Eigen::MatrixXd::Zero(functions, functions)), square(gram) {
  moment.fill(gram);
}

Eigen::VectorXd BoundedRayleighMinimum(const Eigen::MatrixXd& matrix) {
  constexpr int kMaxSteps = 100;
  const Eigen::Index n = matrix.rows();
  // w = z + lift · mean(z) with z ≥ 0 is the cone: w_k ≥ kLeastWeight · mean(w).
  const double lift = kLeastWeight / (1 - kLeastWeight);
  const auto onto_cone = [&](const Eigen::VectorXd& z) -> Eigen::VectorXd {
    return z.array() + lift * z.mean();
  };
  const Eigen::MatrixXd to_cone =
      Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::Constant(n, n, lift / static_cast<double>(n));
  Eigen::MatrixXd h = to_cone * matrix * to_cone;
  h.diagonal().array() += kNullSpace * std::max(h.trace(), 1e-300) / static_cast<double>(n);
  Eigen::VectorXd z = Eigen::VectorXd::Ones(n), w = onto_cone(z).normalized();
  double quotient = w.dot(matrix * w);
  for (int step = 0; step < kMaxSteps; ++step) {
    z = NonNegativeMinimum(h, to_cone * w, z / onto_cone(z).norm());
    const Eigen::VectorXd next = onto_cone(z).normalized();
    const double lower = next.dot(matrix * next);
    if (!(lower < quotient)) break;
    const bool done = quotient - lower <= 1e-12 * quotient;
    w = next;
    quotient = lower;
    if (done) break;
  }
  return w;
}

RationalSolution SolveRationalSums(const RationalSums& sums) {
  const Eigen::Index n = sums.gram.rows();
  const Eigen::LDLT<Eigen::MatrixXd> gram(sums.gram);
  const Eigen::VectorXd pivots = gram.vectorD();
  if (gram.info() != Eigen::Success || !(pivots.minCoeff() > 1e-15 * pivots.maxCoeff())) {
    throw FitError("the fit at fixed parameters is singular: too few points for the net");
  }
  Eigen::MatrixXd matrix = sums.square;
  for (const Eigen::MatrixXd& moment : sums.moment) matrix -= moment * gram.solve(moment);
  matrix = (0.5 * (matrix + matrix.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  if (eigen.info() != Eigen::Success) throw FitError("the weights' eigenvalues were not found");
  // Rounding is that of what M is a difference of.
  const double zero = kNullSpace * sums.square.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Index null = std::max<Eigen::Index>(1, (eigen.eigenvalues().array() <= zero).count());
  const auto space = eigen.eigenvectors().leftCols(null);
  RationalSolution solution;
  solution.weights = space * (space.transpose() * Eigen::VectorXd::Ones(n));
  solution.bounded = !IsPositive(solution.weights);
  if (solution.bounded) solution.weights = BoundedRayleighMinimum(matrix);
  solution.quotient =
      std::max(0.0, solution.weights.dot(matrix * solution.weights)) / solution.weights.squaredNorm();
  solution.weights /= solution.weights.mean();
  solution.points.resize(n, 3);
  for (Eigen::Index c = 0; c < 3; ++c) {
    solution.points.col(c) = gram.solve(sums.moment[static_cast<std::size_t>(c)] * solution.weights);
  }
  solution.points.array().colwise() /= solution.weights.array();
  return solution;
}

}  // namespace frond
