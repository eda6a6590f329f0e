// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "solvers/fit_problem.h"

namespace frond {

// A row of Moré and Wild's table of 53 problems: a function of more_wild_functions.h with n parameters and m
// residuals, started from 10^start_exponent times its standard start.
struct MoreWildRow {
  int function;
  int n, m;
  int start_exponent;
};

// The standard start of `function` with n parameters: that of Moré, Garbow and Hillstrom (1981) or CUTEr,
// save for Watson's, which Moré and Wild moved from 0 to (½, …, ½).
std::vector<double> MoreWildStart(int function, int n);

// A problem of Moré and Wild (2009):
//
//   minimise ½ Σ_i r_i(x)²   over the free block "x";
//
// half of their f. One residual block. Starts are drawn, by solvers that draw them, from a box made of the
// start s alone: [s_j − e_j, s_j + e_j], e_j = max(1, |s_j|).
class MoreWildFit : public FitProblem {
 public:
  explicit MoreWildFit(const MoreWildRow& row);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  double Objective(std::span<const double> x) const override;

 private:
  MoreWildRow row_;
  std::vector<ParameterBlock> parameters_;
};

}  // namespace frond
