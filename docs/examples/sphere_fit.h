// SPDX-License-Identifier: BSD-3-Clause
// The example of docs/add_a_fit.md, which shows parts of this file.
#pragma once

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "solvers/fit_problem.h"

namespace frond {

// residual = |c − Q| − r.  Blocks: centre c (3), radius r (1).
struct SphereResidual {
  Eigen::Vector3d point;

  template <typename T>
  bool operator()(const T* centre, const T* radius, T* residual) const {
    residual[0] = (Eigen::Map<const Eigen::Matrix<T, 3, 1>>(centre) - point.cast<T>()).norm() - radius[0];
    return true;
  }
};

// A sphere through points by least orthogonal distances, from the mean of the points and a radius.
class SphereFit final : public FitProblem {
 public:
  SphereFit(std::vector<Eigen::Vector3d> points, double radius) : points_(std::move(points)) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points_) mean += point / static_cast<double>(points_.size());
    ParameterBlock centre{.name = "centre", .start = {mean.x(), mean.y(), mean.z()}};
    for (const double value : centre.start) {  // where swarms begin
      centre.start_lower.push_back(value - 4 * radius);
      centre.start_upper.push_back(value + 4 * radius);
    }
    parameters_ = {centre,
                   {.name = "radius",
                    .start = {radius},
                    .lower = {0},
                    .upper = {std::numeric_limits<double>::infinity()},
                    .start_lower = {0},
                    .start_upper = {4 * radius}}};
  }

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }

  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                    ceres::Problem* problem) const override {
    for (const Eigen::Vector3d& point : points_) {
      problem->AddResidualBlock(
          new ceres::AutoDiffCostFunction<SphereResidual, 1, 3, 1>(new SphereResidual{point}), nullptr,
          blocks[0], blocks[1]);
    }
  }

  std::map<std::string, double> Metrics(std::span<const double> x) const override {
    return {{"radius", x[3]}, {"rmse", std::sqrt(2 * Objective(x) / static_cast<double>(points_.size()))}};
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<ParameterBlock> parameters_;
};

}  // namespace frond
