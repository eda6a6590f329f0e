// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/local_quadric_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/median.h"

namespace frond {
namespace {

using Row = Eigen::Matrix<double, 6, 1>;
constexpr std::size_t kQuadraticFrom = 12;
constexpr int kRounds = 4;

Row RowOf(const HeightSample& s, double scale, bool quadratic) {
  const double x = s.x / scale, y = s.y / scale;
  Row row = Row::Zero();
  row.head<3>() << 1, x, y;
  if (quadratic) row.tail<3>() << x * x, x * y, y * y;
  return row;
}

// Least squares with the weights given; false where the samples do not tell the coefficients.
bool Solve(std::span<const HeightSample> samples, std::span<const double> weights, double scale,
           bool quadratic, HeightFit* fit) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Row right = Row::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Row row = RowOf(samples[i], scale, quadratic);
    normal += weights[i] * row * row.transpose();
    right += weights[i] * samples[i].height * row;
    sum += weights[i];
  }
  if (!(sum > 0)) return false;
  if (!quadratic) normal.bottomRightCorner<3, 3>().diagonal().setConstant(sum);
  normal.diagonal().tail<5>().array() += 1e-6 * sum;  // samples on a line leave a slope open: none
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> factor(normal);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return false;
  fit->coefficients = factor.solve(right);
  const Row middle = factor.solve(Row::Unit(0));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Row row = RowOf(samples[i], scale, quadratic);
    fit->share[i] = weights[i] * middle.dot(row);
    fit->residual[i] = samples[i].height - fit->coefficients.dot(row);
  }
  return fit->coefficients.allFinite();
}

}  // namespace

HeightFit FitHeight(std::span<const HeightSample> samples, double outlier_sigmas) {
  HeightFit fit;
  fit.share.resize(samples.size());
  fit.residual.resize(samples.size());
  const bool quadratic = samples.size() >= kQuadraticFrom;
  double scale = 0;
  for (const HeightSample& s : samples) scale = std::max(scale, std::hypot(s.x, s.y));
  if (!(scale > 0)) return fit;
  std::vector<double> weights, off(samples.size());
  for (const HeightSample& s : samples) weights.push_back(s.weight);
  for (int round = 0; round < kRounds; ++round) {
    // A plane first: gross errors bend a quadratic towards themselves.
    if (!Solve(samples, weights, scale, quadratic && round > 0, &fit)) return fit;
    for (std::size_t i = 0; i < samples.size(); ++i) off[i] = std::abs(fit.residual[i]);
    const double scatter = 1.4826 * Median(off);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double r = off[i] / (outlier_sigmas * std::max(samples[i].sigma, scatter));
      weights[i] = r < 1 ? samples[i].weight * (1 - r * r) * (1 - r * r) : 0;
    }
  }
  fit.coefficients.segment<2>(1) /= scale;
  fit.coefficients.tail<3>() /= scale * scale;
  fit.solved = true;
  return fit;
}

}  // namespace frond
