// SPDX-License-Identifier: BSD-3-Clause
// Small fits with known answers, which count the calls of their own functors.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solvers/fit_problem.h"
#include "solvers/solver.h"

namespace frond {

// Calls of a functor, by scalar type: double for residuals alone, Jets for Jacobians.
struct CallCounts {
  std::atomic<std::int64_t> residual{0};
  std::atomic<std::int64_t> jacobian{0};
};

// Base of the fits below: parameters open to tests, calls counted.
class TestFit : public FitProblem {
 public:
  const std::vector<ParameterBlock>& parameters() const override { return blocks; }
  Derivatives derivatives() const override { return derivatives_charged; }

  std::vector<ParameterBlock> blocks;
  Derivatives derivatives_charged = Derivatives::kAnalytic;
  std::shared_ptr<CallCounts> calls = std::make_shared<CallCounts>();
};

// ½[(10(y − x²))² + (1 − x)²] from (−1.2, 1): minimum 0 at (1, 1).
class RosenbrockFit : public TestFit {
 public:
  RosenbrockFit();
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
};

// The same with central differences.
class NumericRosenbrockFit : public RosenbrockFit {
 public:
  NumericRosenbrockFit() { derivatives_charged = Derivatives::kNumeric; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
};

// NIST StRD Misra1a, y = b1 (1 − exp(−b2 x)), from its start 2; b1 and b2 are blocks of their own.
class Misra1aFit : public TestFit {
 public:
  static constexpr double kB1 = 2.3894212918E+02;  // certified
  static constexpr double kB2 = 5.5015643181E-04;
  static constexpr double kResidualSumOfSquares = 1.2455138894E-01;

  Misra1aFit();
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
};

// A straight line a + b t through (0, 1), (1, 3), (2, 4), (3, 4): the normal equations give a = 1.5, b = 1
// and the cost ½ · 1 = 0.5.
class LineFit : public TestFit {
 public:
  LineFit();
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
};

// A residual that is NaN left of `valid_from` and x − 1 right of it.
class PartlyNanFit : public TestFit {
 public:
  PartlyNanFit(double start, double valid_from);
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;

 private:
  double valid_from_;
};

// Least squares pull x towards 0 and 4, to 2, while the objective is max(|x|, |x − 4|) + p |x − 1|: with p =
// 0.5
// (`agree`) it is least at 2 as well, with p = 3 at 1.
class MinimaxFit : public TestFit {
 public:
  explicit MinimaxFit(double start, bool agree = true);
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  bool ObjectiveIsLeastSquares() const override { return false; }
  double Objective(std::span<const double> x) const override;

 private:
  double pull_;
};

// A box around all values of the fit's blocks.
void SetBox(double lower, double upper, TestFit* fit);

// The solver `name` with options {name, value} set.
std::unique_ptr<Solver> MakeSolver(const std::string& name,
                                   const std::vector<std::pair<std::string, OptionValue>>& options = {});

}  // namespace frond
