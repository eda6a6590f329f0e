// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/nist_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "problems/standard/nist_models.h"
#include "problems/standard/rounding_floor.h"
#include "solvers/comparison/log_relative_error.h"

namespace frond {
namespace {

// r_i = y_i − f(x_i; b), all observations.
template <typename Model>
struct NistResiduals {
  std::span<const double> responses;
  std::span<const double> x;  // responses.size() × predictors
  int predictors;

  template <typename T>
  bool operator()(const T* b, T* residuals) const {
    const double* observed = x.data();
    for (std::size_t i = 0; i < responses.size(); ++i, observed += predictors) {
      residuals[i] = responses[i] - Model()(b, observed);
    }
    return true;
  }
};

template <typename Model>
double HalfSumOfSquares(const NistResiduals<Model>& residuals, const double* b) {
  double sum = 0;
  const double* observed = residuals.x.data();
  for (const double response : residuals.responses) {
    const double residual = response - Model()(b, observed);
    sum += residual * residual;
    observed += residuals.predictors;
  }
  return std::isfinite(sum) ? sum / 2 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

NistFit::NistFit(const NistDataset& dataset, int start)
    : dataset_(dataset), responses_(NistResponses(dataset)) {
  if (start != 1 && start != 2) throw std::invalid_argument("NIST has starts 1 and 2");
  ParameterBlock block{.name = "b", .start = {}};
  for (const NistParameter& parameter : dataset.parameters) {
    const double s = parameter.start_1, t = parameter.start_2;
    const double margin = std::max(std::abs(s), std::abs(t));
    block.start.push_back(start == 1 ? s : t);
    block.start_lower.push_back(std::min(s, t) - margin);
    block.start_upper.push_back(std::max(s, t) + margin);
  }
  parameters_ = {std::move(block)};
}

void NistFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                           ceres::Problem* problem) const {
  WithNistModel(dataset_.name, [&]<typename Model>(Model) {
    using Residuals = NistResiduals<Model>;
    problem->AddResidualBlock(
        new ceres::AutoDiffCostFunction<Residuals, ceres::DYNAMIC, Model::kParameters>(
            new Residuals{responses_, dataset_.x, dataset_.predictors}, static_cast<int>(responses_.size())),
        nullptr, blocks[0]);
  });
}

double NistFit::Objective(std::span<const double> x) const {
  return WithNistModel(dataset_.name, [&]<typename Model>(Model) {
    return HalfSumOfSquares(NistResiduals<Model>{responses_, dataset_.x, dataset_.predictors}, x.data());
  });
}

std::map<std::string, double> NistFit::Metrics(std::span<const double> x) const {
  const double rss = 2 * Objective(x);
  double digits = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    digits = std::min(digits, LogRelativeError(x[i], dataset_.parameters[i].certified));
  }
  return {{"digits", digits}, {"cost_digits", LogRelativeError(rss, dataset_.rss)}, {"rss", rss}};
}

double NistResolution(const NistDataset& dataset) {
  constexpr double kPrinted = 1e-12;
  const std::vector<double> responses = NistResponses(dataset);
  const double square = std::inner_product(responses.begin(), responses.end(), responses.begin(), 0.0);
  return RoundingFloor(std::sqrt(dataset.rss), std::sqrt(square)) + kPrinted * kPrinted * square / 2;
}

}  // namespace frond
