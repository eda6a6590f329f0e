// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/parametric_start.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "base/errors.h"
#include "problems/curve/curve_distance_fit.h"

namespace frond {
namespace {

constexpr double kLeastWeight = 0.05;

struct BasisRow {
  std::array<double, kMaxDegree + 1> values;
  std::array<Eigen::Index, kMaxDegree + 1> columns;  // distinct control points
};

BasisRow RowAt(const BSplineBasis& basis, double parameter) {
  BasisRow row;
  const double t = basis.IntoDomain(parameter);
  const int span = basis.FindSpan(t), p = basis.degree();
  basis.Evaluate(span, t, 0, row.values.data());
  for (int a = 0; a <= p; ++a) {
    row.columns[static_cast<std::size_t>(a)] = (span - p + a) % basis.num_distinct_control_points();
  }
  return row;
}

Eigen::MatrixXd BendingMatrix(const BSplineBasis& basis) {
  const SpanPolynomials spans(basis);
  const std::vector<Eigen::MatrixXd> grams = BendingGram(spans, basis.end() - basis.begin());
  const int n = basis.num_distinct_control_points();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < spans.count(); ++k) {
    const Eigen::MatrixXd& gram = grams[static_cast<std::size_t>(k)];
    for (int a = 0; a < gram.rows(); ++a) {
      for (int b = 0; b < gram.cols(); ++b) {
        matrix((spans.first(k) + a) % n, (spans.first(k) + b) % n) += gram(a, b);
      }
    }
  }
  return matrix;
}

// Minimises wᵀHw, H positive definite, Σw = n, w ≥ bound.
Eigen::VectorXd MinimiseOnSimplex(const Eigen::MatrixXd& h, double bound) {
  const Eigen::Index n = h.rows();
  Eigen::VectorXd w = Eigen::VectorXd::Ones(n);
  std::vector<bool> held(static_cast<std::size_t>(n), false);
  for (Eigen::Index round = 0; round < 10 * n; ++round) {
    std::vector<Eigen::Index> free, at_bound;
    for (Eigen::Index i = 0; i < n; ++i) (held[static_cast<std::size_t>(i)] ? at_bound : free).push_back(i);
    const Eigen::LDLT<Eigen::MatrixXd> factor(h(free, free));
    const auto num_free = static_cast<Eigen::Index>(free.size());
    const Eigen::VectorXd ones = factor.solve(Eigen::VectorXd::Ones(num_free));
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(num_free);
    for (const Eigen::Index j : at_bound) pull += bound * h(free, std::vector<Eigen::Index>{j});
    const Eigen::VectorXd offset = factor.solve(pull);
    const double total = static_cast<double>(n) - bound * static_cast<double>(at_bound.size());
    const double multiplier = (total + offset.sum()) / ones.sum();
    const Eigen::VectorXd target = multiplier * ones - offset;
    double share = 1;
    Eigen::Index blocking = -1;
    for (Eigen::Index k = 0; k < num_free; ++k) {
      const double now = w[free[static_cast<std::size_t>(k)]];
      if (target[k] >= bound || !(now > target[k])) continue;
      const double reach = (now - bound) / (now - target[k]);
      if (reach >= share) continue;
      share = reach;
      blocking = free[static_cast<std::size_t>(k)];
    }
    for (Eigen::Index k = 0; k < num_free; ++k) {
      double& value = w[free[static_cast<std::size_t>(k)]];
      value += share * (target[k] - value);
    }
    if (blocking >= 0) {
      w[blocking] = bound;
      held[static_cast<std::size_t>(blocking)] = true;
      continue;
    }
    const Eigen::VectorXd gradient = h * w;  // equals the multiplier where free
    Eigen::Index release = -1;
    for (const Eigen::Index j : at_bound) {
      if (gradient[j] < multiplier * (1 - 1e-9) && (release < 0 || gradient[j] < gradient[release]))
        release = j;
    }
    if (release < 0) break;
    held[static_cast<std::size_t>(release)] = false;
  }
  return w;
}

}  // namespace

NurbsCurve FitCurveAtParameters(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                                const BSplineBasis& basis, double fairness,
                                const std::vector<double>& weights) {
  const int n = basis.num_distinct_control_points(), p = basis.degree();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n), rhs = Eigen::MatrixXd::Zero(n, 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    BasisRow row = RowAt(basis, parameters[i]);
    double denominator = 0;
    for (std::size_t a = 0; a <= static_cast<std::size_t>(p); ++a) {
      if (!weights.empty()) row.values[a] *= weights[static_cast<std::size_t>(row.columns[a])];
      denominator += row.values[a];
    }
    for (std::size_t a = 0; a <= static_cast<std::size_t>(p); ++a) {
      const double value = row.values[a] / denominator;
      rhs.row(row.columns[a]) += value * points[i].transpose();
      for (std::size_t b = 0; b <= static_cast<std::size_t>(p); ++b) {
        normal(row.columns[a], row.columns[b]) += value * row.values[b] / denominator;
      }
    }
  }
  const Eigen::MatrixXd bending = static_cast<double>(points.size()) * BendingMatrix(basis);
  for (double lambda = fairness; lambda <= std::max(1e-4, fairness); lambda = std::max(100 * lambda, 1e-14)) {
    Eigen::MatrixXd matrix = normal + lambda * bending;
    // Scaled to a unit diagonal: short spans bend much, which is no lack of points.
    const Eigen::VectorXd scale = matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
    if (factor.info() != Eigen::Success || !(factor.rcond() > 1e-14)) continue;
    const Eigen::MatrixXd solution = scale.asDiagonal() * factor.solve(scale.asDiagonal() * rhs);
    std::vector<Eigen::Vector3d> control_points;
    for (int k = 0; k < basis.num_control_points(); ++k) {
      control_points.emplace_back(solution.row(k % n).transpose());
    }
    return NurbsCurve(basis, std::move(control_points), weights);
  }
  throw FitError("the points do not determine " + std::to_string(n) +
                 " control points at these parameters; take fewer (curve.control_points)");
}

std::vector<double> MaWeights(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                              const BSplineBasis& basis) {
  const int n = basis.num_distinct_control_points(), p = basis.degree();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), squares = a;  // NᵀN, Nᵀ|Q|²N
  std::array<Eigen::MatrixXd, 3> b = {a, a, a};                  // NᵀQ_xN
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BasisRow row = RowAt(basis, parameters[i]);
    for (std::size_t j = 0; j <= static_cast<std::size_t>(p); ++j) {
      for (std::size_t k = 0; k <= static_cast<std::size_t>(p); ++k) {
        const Eigen::Index r = row.columns[j], c = row.columns[k];
        const double product = row.values[j] * row.values[k];
        a(r, c) += product;
        squares(r, c) += product * points[i].squaredNorm();
        for (std::size_t x = 0; x < 3; ++x) b[x](r, c) += product * points[i][static_cast<Eigen::Index>(x)];
      }
    }
  }
  a.diagonal().array() += 1e-12 * a.trace() / n;  // control points without a point
  const Eigen::LDLT<Eigen::MatrixXd> factor(a);
  Eigen::MatrixXd m = squares;
  for (const Eigen::MatrixXd& moment : b) m -= moment * factor.solve(moment);
  m = (0.5 * (m + m.transpose())).eval();
  // M is singular where the points can be met; near-equal weights are then the choice.
  m.diagonal().array() += 1e-9 * std::max(m.trace(), 1e-9 * squares.trace()) / n;
  const Eigen::VectorXd w = MinimiseOnSimplex(m, kLeastWeight);
  std::vector<double> weights;
  for (int k = 0; k < basis.num_control_points(); ++k) weights.push_back(w[k % n]);
  return weights;
}

}  // namespace frond
