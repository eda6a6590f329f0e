// SPDX-License-Identifier: BSD-3-Clause
#include "tests/solvers/test_fits.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/numeric_diff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace frond {
namespace {

template <typename T>
void Count(CallCounts* calls) {
  ++(std::is_same_v<T, double> ? calls->residual : calls->jacobian);
}

struct RosenbrockResidual {
  CallCounts* calls;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    Count<T>(calls);
    residual[0] = 10.0 * (x[1] - x[0] * x[0]);
    residual[1] = 1.0 - x[0];
    return true;
  }
};

struct Misra1aResidual {
  static constexpr int kPoints = 14;
  static constexpr double kY[kPoints] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                         44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  static constexpr double kX[kPoints] = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                         378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
  CallCounts* calls;

  template <typename T>
  bool operator()(const T* b1, const T* b2, T* residual) const {
    Count<T>(calls);
    using std::exp;
    for (int i = 0; i < kPoints; ++i) residual[i] = b1[0] * (1.0 - exp(-b2[0] * kX[i])) - kY[i];
    return true;
  }
};

struct LineResidual {
  CallCounts* calls;

  template <typename T>
  bool operator()(const T* line, T* residual) const {
    Count<T>(calls);
    constexpr double kY[4] = {1, 3, 4, 4};
    for (int i = 0; i < 4; ++i) residual[i] = line[0] + line[1] * static_cast<double>(i) - kY[i];
    return true;
  }
};

struct PartlyNanResidual {
  double valid_from;
  CallCounts* calls;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    Count<T>(calls);
    residual[0] = x[0] - 1.0;
    if (x[0] < T(valid_from)) residual[0] = T(std::numeric_limits<double>::quiet_NaN());
    return true;
  }
};

struct TwoPulls {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = x[0];
    residual[1] = x[0] - 4.0;
    return true;
  }
};

}  // namespace

void NumericRosenbrockFit::AddResiduals(const std::vector<double*>& values,
                                        ceres::EvaluationCallback* /*state*/, ceres::Problem* problem) const {
  problem->AddResidualBlock(new ceres::NumericDiffCostFunction<RosenbrockResidual, ceres::CENTRAL, 2, 2>(
                                new RosenbrockResidual{calls.get()}),
                            nullptr, values[0]);
}

RosenbrockFit::RosenbrockFit() { blocks = {{.name = "x", .start = {-1.2, 1}}}; }

void RosenbrockFit::AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                                 ceres::Problem* problem) const {
  problem->AddResidualBlock(
      new ceres::AutoDiffCostFunction<RosenbrockResidual, 2, 2>(new RosenbrockResidual{calls.get()}), nullptr,
      values[0]);
}

Misra1aFit::Misra1aFit() { blocks = {{.name = "b1", .start = {250}}, {.name = "b2", .start = {0.0005}}}; }

void Misra1aFit::AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                              ceres::Problem* problem) const {
  problem->AddResidualBlock(new ceres::AutoDiffCostFunction<Misra1aResidual, Misra1aResidual::kPoints, 1, 1>(
                                new Misra1aResidual{calls.get()}),
                            nullptr, values[0], values[1]);
}

LineFit::LineFit() { blocks = {{.name = "line", .start = {-3, 5}}}; }

void LineFit::AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                           ceres::Problem* problem) const {
  problem->AddResidualBlock(
      new ceres::AutoDiffCostFunction<LineResidual, 4, 2>(new LineResidual{calls.get()}), nullptr, values[0]);
}

PartlyNanFit::PartlyNanFit(double start, double valid_from) : valid_from_(valid_from) {
  blocks = {{.name = "x", .start = {start}}};
}

void PartlyNanFit::AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                                ceres::Problem* problem) const {
  problem->AddResidualBlock(new ceres::AutoDiffCostFunction<PartlyNanResidual, 1, 1>(
                                new PartlyNanResidual{valid_from_, calls.get()}),
                            nullptr, values[0]);
}

MinimaxFit::MinimaxFit(double start, bool agree) : pull_(agree ? 0.5 : 3) {
  blocks = {{.name = "x", .start = {start}}};
}

void MinimaxFit::AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                              ceres::Problem* problem) const {
  problem->AddResidualBlock(new ceres::AutoDiffCostFunction<TwoPulls, 2, 1>(new TwoPulls), nullptr,
                            values[0]);
}

double MinimaxFit::Objective(std::span<const double> x) const {
  return std::max(std::abs(x[0]), std::abs(x[0] - 4)) + pull_ * std::abs(x[0] - 1);
}

void SetBox(double lower, double upper, TestFit* fit) {
  for (ParameterBlock& block : fit->blocks) {
    block.lower.assign(block.start.size(), lower);
    block.upper.assign(block.start.size(), upper);
  }
}

std::unique_ptr<Solver> MakeSolver(const std::string& name,
                                   const std::vector<std::pair<std::string, OptionValue>>& options) {
  const SolverType& type = FindSolverType(name);
  Options values(type.options);
  for (const auto& [option, value] : options) values.Set(option, value);
  return type.create(values);
}

}  // namespace frond
