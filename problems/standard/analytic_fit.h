// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "solvers/fit_problem.h"

namespace frond {

// Where a function's minimiser lies and how its axes do.
struct AnalyticPlacement {
  bool shift = false;   // minimiser drawn, else the textbook's
  bool rotate = false;  // about the minimiser
  int instance = 1;     // of both; the same instance, function and dimension give the same bytes
};

// A function f of analytic_functions.h in n dimensions, over the block "x" in the function's customary box:
//
//   minimise f(z),   z = R (x − x*) + z*,
//
// z* the textbook's minimiser, x* the one here, R a rotation or reflection (n × n, orthogonal, from the QR
// factors of normal numbers, so that all are equally likely). x* is z*, or with `shift` uniform in the middle
// 80 % of the box; for Schwefel's, whose waves the box cuts off not far from z*, within 50 of z* in each
// coordinate: moved further, much of the box would map to beyond them. Without shift and rotation z = x. x*
// is in the box in any case, and f = 0 there. The start is fixed by the box alone: 0.1 + 0.8 (j φ mod 1) of
// the way through it in coordinate j = 1 … n, φ the golden ratio.
class AnalyticFit : public FitProblem {
 public:
  AnalyticFit(const std::string& function, int dimension, const AnalyticPlacement& placement = {});

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  double Objective(std::span<const double> x) const override;  // the textbook's value

  const std::vector<double>& minimiser() const { return minimiser_; }  // x*
  const Eigen::MatrixXd& rotation() const { return rotation_; }        // R, 0 × 0 where there is none

 private:
  template <typename T>
  void Place(const T* x, T* z) const;
  template <typename Function>
  struct Residuals;

  std::string function_;
  int dimension_;
  bool shift_;
  double textbook_minimiser_;
  std::vector<double> minimiser_;
  Eigen::MatrixXd rotation_;
  std::vector<ParameterBlock> parameters_;
};

}  // namespace frond
