// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/analytic_fit.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/random.h"
#include "problems/standard/analytic_functions.h"

namespace frond {
namespace {

Eigen::MatrixXd RandomOrthogonal(int n, Random random) {
  Eigen::MatrixXd normals(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) normals(i, j) = random.Normal();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(normals);
  Eigen::MatrixXd q = qr.householderQ();
  // R's diagonal made positive: without, Q is not uniform (Mezzadri, "How to generate random matrices from
  // the classical compact groups", Notices of the AMS 54, 2007).
  for (int j = 0; j < n; ++j) {
    if (qr.matrixQR()(j, j) < 0) q.col(j) *= -1;
  }
  return q;
}

std::vector<double> DrawMinimiser(const std::string& function, int n, double limit, double textbook,
                                  Random random) {
  constexpr double kMiddle = 0.8, kSchwefelShift = 50;
  std::vector<double> minimiser(n);
  for (double& value : minimiser) {
    value = function == "schwefel" ? textbook + random.Uniform(-kSchwefelShift, kSchwefelShift)
                                   : kMiddle * random.Uniform(-limit, limit);
  }
  return minimiser;
}

}  // namespace

AnalyticFit::AnalyticFit(const std::string& function, int dimension, const AnalyticPlacement& placement)
    : function_(function), dimension_(dimension), shift_(placement.shift) {
  if (dimension < 2) throw std::invalid_argument("analytic functions have two dimensions or more");
  double limit = 0;
  WithAnalyticFunction(function, [&]<typename Function>(Function) {
    limit = Function::kLimit;
    textbook_minimiser_ = Function::kMinimiser;
  });
  const auto seed = static_cast<std::uint64_t>(placement.instance);
  const std::string key = function + "/" + std::to_string(dimension);
  minimiser_ = placement.shift ? DrawMinimiser(function, dimension, limit, textbook_minimiser_,
                                               Random::ForKey(seed, "shift/" + key))
                               : std::vector<double>(dimension, textbook_minimiser_);
  if (placement.rotate) rotation_ = RandomOrthogonal(dimension, Random::ForKey(seed, "rotation/" + key));

  ParameterBlock block{.name = "x", .start = {}};
  for (int j = 1; j <= dimension; ++j) {
    const double turns = j * std::numbers::phi;
    block.start.push_back(limit * (2 * (0.1 + 0.8 * (turns - std::floor(turns))) - 1));
  }
  block.lower.assign(dimension, -limit);
  block.upper.assign(dimension, limit);
  parameters_ = {std::move(block)};
}

template <typename T>
void AnalyticFit::Place(const T* x, T* z) const {
  const bool rotate = rotation_.size() > 0;
  for (int i = 0; i < dimension_; ++i) {
    if (!rotate) {
      z[i] = shift_ ? x[i] - minimiser_[i] + textbook_minimiser_ : x[i];
      continue;
    }
    T sum(0.0);
    for (int j = 0; j < dimension_; ++j) sum += rotation_(i, j) * (x[j] - minimiser_[j]);
    z[i] = sum + textbook_minimiser_;
  }
}

// r(z(x)), block "x".
template <typename Function>
struct AnalyticFit::Residuals {
  const AnalyticFit* fit;

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    std::vector<T> z(fit->dimension_);
    fit->Place(blocks[0], z.data());
    Function::Residuals(fit->dimension_, z.data(), residuals);
    return true;
  }
};

void AnalyticFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                               ceres::Problem* problem) const {
  WithAnalyticFunction(function_, [&]<typename Function>(Function) {
    auto* cost =
        new ceres::DynamicAutoDiffCostFunction<Residuals<Function>, 4>(new Residuals<Function>{this});
    cost->AddParameterBlock(dimension_);
    cost->SetNumResiduals(Function::ResidualCount(dimension_));
    problem->AddResidualBlock(cost, nullptr, blocks[0]);
  });
}

double AnalyticFit::Objective(std::span<const double> x) const {
  std::vector<double> z(dimension_);
  Place(x.data(), z.data());
  const double value =
      WithAnalyticFunction(function_, [&]<typename Function>(Function) { return Function::Value(z); });
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace frond
