// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solvers/fit_problem.h"

namespace frond {

// A fit that is the same in all but its start.
class FitFrom final : public FitProblem {
 public:
  // `fit` must outlive this; `start` has fit.NumParameters() values (those of constant blocks are not taken).
  FitFrom(const FitProblem& fit, std::span<const double> start);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& blocks,
                                                         int threads) const override {
    return fit_.CreateState(blocks, threads);
  }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override {
    fit_.AddResiduals(blocks, state, problem);
  }
  double Objective(std::span<const double> x) const override { return fit_.Objective(x); }
  bool ObjectiveIsLeastSquares() const override { return fit_.ObjectiveIsLeastSquares(); }
  Derivatives derivatives() const override { return fit_.derivatives(); }
  std::map<std::string, double> Metrics(std::span<const double> x) const override { return fit_.Metrics(x); }

 private:
  const FitProblem& fit_;
  std::vector<ParameterBlock> parameters_;
};

}  // namespace frond
