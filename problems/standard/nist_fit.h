// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "problems/standard/nist_data.h"
#include "solvers/fit_problem.h"

namespace frond {

// One of NIST's regressions from one of its two starts:
//
//   minimise ½ Σ_i (y_i − f(x_i; b))²   over the free block "b",   log y_i for Nelson.
//
// One residual block with all observations, so that `lm`'s dense QR works on the Jacobian itself (the normal
// equations would lose half of the digits). Starts are drawn, by solvers that draw them, from a box made of
// the two published starts s and t alone, never from the answer: [min(s, t) − e, max(s, t) + e] with
// e = max(|s|, |t|), for each parameter.
class NistFit : public FitProblem {
 public:
  // `start`: 1 (far) or 2 (near). Views `dataset`.
  NistFit(const NistDataset& dataset, int start);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  double Objective(std::span<const double> x) const override;

  // "digits": the least log relative error −log₁₀(|b − c|/|c|) over the parameters, c the certified ones, in
  // [0, 11]; "cost_digits": that of the residual sum of squares; "rss": that sum. NaN has 0 digits.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

 private:
  const NistDataset& dataset_;
  std::vector<double> responses_;
  std::vector<ParameterBlock> parameters_;
};

// Below this, absolutely, differences of a dataset's objective mean nothing: RoundingFloor of the certified
// residuals, plus what explains the responses to 1e-12 of their norm. NIST prints no observation to more than
// 13 digits, so that a smaller sum of squares is made of the rounding of the printed data: Lanczos1, exact
// but for it, has 1.4e-25 and a floor of 1e-23. The second part is below 1e-12 of the sum everywhere else.
double NistResolution(const NistDataset& dataset);

}  // namespace frond
