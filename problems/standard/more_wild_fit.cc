// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/more_wild_fit.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "problems/standard/more_wild_functions.h"

namespace frond {
namespace {

struct RowResiduals {
  MoreWildRow row;

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    MoreWildResiduals(row.function, row.n, row.m, blocks[0], residuals);
    return true;
  }
};

// CUTEr's start of MANCINO, −b r_i(0) with b = βn / (β²n² − (α + 1)²(n − 1)²), α = 5, β = 14 and n = 100, cut
// to 7 digits as in Moré and Wild's supplement.
std::vector<double> MancinoStart(int n) {
  const std::vector<double> zero(n, 0.0);
  std::vector<double> start(n);
  more_wild::Mancino(n, zero.data(), start.data());
  for (double& value : start) value *= -8.710996e-4;
  return start;
}

}  // namespace

std::vector<double> MoreWildStart(int function, int n) {
  switch (function) {
    case 4:
      return {-1.2, 1};
    case 5:
      return {-1, 0, 0};
    case 6:
      return {3, -1, 0, 1};
    case 7:
      return {.5, -2};
    case 9:
      return {.25, .39, .415, .39};
    case 10:
      return {.02, 4000, 250};
    case 11:
    case 16:
    case 20:
      return std::vector<double>(n, .5);
    case 12:
      return {0, 10, 20};
    case 13:
      return {.3, .4};
    case 14:
      return {25, 5, -5, -1};
    case 15: {
      std::vector<double> start;
      for (int j = 1; j <= n; ++j) start.push_back(j / (n + 1.0));
      return start;
    }
    case 17:
      return {.5, 1.5, 1, .01, .02};
    case 18:
      return {1.3, .65, .65, .7, .6, 3, 5, 7, 2, 4.5, 5.5};
    case 21:
      return MancinoStart(n);
    case 22:
      return {-.3, -.39, .3, -.344, -1.2, 2.69, 1.59, -1.5};
    default:  // the linear functions, Bard, BDQRTIC
      return std::vector<double>(n, 1.0);
  }
}

MoreWildFit::MoreWildFit(const MoreWildRow& row) : row_(row) {
  ParameterBlock block{.name = "x", .start = MoreWildStart(row.function, row.n)};
  for (double& value : block.start) {
    value *= std::pow(10.0, row.start_exponent);
    const double margin = std::max(1.0, std::abs(value));
    block.start_lower.push_back(value - margin);
    block.start_upper.push_back(value + margin);
  }
  parameters_ = {std::move(block)};
}

void MoreWildFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                               ceres::Problem* problem) const {
  // Dynamic: one instance of the functions' code for all n.
  auto* cost = new ceres::DynamicAutoDiffCostFunction<RowResiduals, 4>(new RowResiduals{row_});
  cost->AddParameterBlock(row_.n);
  cost->SetNumResiduals(row_.m);
  problem->AddResidualBlock(cost, nullptr, blocks[0]);
}

double MoreWildFit::Objective(std::span<const double> x) const {
  std::vector<double> residuals(row_.m);
  MoreWildResiduals(row_.function, row_.n, row_.m, x.data(), residuals.data());
  double sum = 0;
  for (const double residual : residuals) sum += residual * residual;
  return std::isfinite(sum) ? sum / 2 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace frond
