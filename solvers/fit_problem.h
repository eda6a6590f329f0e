// SPDX-License-Identifier: BSD-3-Clause
// The contract between a fit and a solver. A fit is written once, as residual blocks over named parameter
// blocks; least-squares solvers see it as a ceres::Problem, derivative-free ones as a scalar function of one
// flat vector x (all parameter blocks one after the other).
#pragma once

#include <ceres/evaluation_callback.h>
#include <ceres/problem.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frond {

struct ParameterBlock {
  std::string name;
  std::vector<double> start;
  std::vector<double> lower = {}, upper = {};           // empty, or one bound a value (± infinity allowed)
  std::shared_ptr<ceres::Manifold> manifold = nullptr;  // null: Euclidean
  bool constant = false;                                // held at its start by every solver
  // Where solvers that draw their first points draw them (within the bounds, finite); empty: the bounds.
  std::vector<double> start_lower = {}, start_upper = {};
};

// How the fit's Jacobians come about: an auto-diff or structured one is charged one residual evaluation a
// parameter, a numeric one two (MATH.md §7).
enum class Derivatives { kAnalytic, kNumeric };

class FitProblem {
 public:
  virtual ~FitProblem() = default;

  virtual const std::vector<ParameterBlock>& parameters() const = 0;

  // State shared by the residual blocks of one ceres::Problem and brought up to date before each evaluation
  // (foot points, regrouping). Null where the residuals depend on the parameters alone. `blocks` are the
  // addresses of the parameter blocks' values, in the order of parameters().
  virtual std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& blocks,
                                                                 int threads) const;

  // Adds the residual blocks over `blocks` to `problem`; the parameter blocks are there already. `state` is
  // what CreateState returned for the same problem. `problem` owns the cost and loss functions added and
  // deletes each once, however many of its blocks share it; never add one that another problem holds too.
  virtual void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                            ceres::Problem* problem) const = 0;

  // The scalar to be minimised. The default is Ceres's cost ½ Σ ρ(r²) of a fresh problem at x, NaN where the
  // residuals cannot be evaluated. Re-entrant.
  virtual double Objective(std::span<const double> x) const;

  // False where Objective is not the Ceres cost (the leaf's α₁·RMSE + α₂·MV): least-squares solvers then
  // minimise the residual blocks, and reports give the objective of their result beside.
  virtual bool ObjectiveIsLeastSquares() const { return true; }

  virtual Derivatives derivatives() const { return Derivatives::kAnalytic; }

  // Metrics of a solution in the user's units, by name. None by default.
  virtual std::map<std::string, double> Metrics(std::span<const double> x) const;

  int NumParameters() const;      // values in all blocks, constant ones included
  int NumFreeParameters() const;  // values in the blocks that are not constant
  std::vector<double> StartVector() const;
};

// Throws FitError naming the parameter block whose bounds have the wrong length or cross, whose start lies
// outside of them, or whose start box is not finite, crosses or reaches outside of them (constant blocks may
// have any start and start box). Every solver checks this first.
void CheckParameters(const FitProblem& fit);

// Thrown through Ceres by an evaluation that LeastSquares::SetGate does not let begin.
struct EvaluationRefused {};

// One fit as one ceres::Problem, with the values that it owns. Not to be shared between threads.
class LeastSquares {
 public:
  // Evaluations of the whole problem by Ceres, line searches included: with Jacobians (which bring the
  // residuals along) and without.
  struct Counts {
    std::int64_t residual_evaluations = 0;
    std::int64_t jacobian_evaluations = 0;
  };

  // `threads` go to the fit's state. Throws as CheckParameters does. `fit` must outlive this.
  LeastSquares(const FitProblem& fit, int threads);
  ~LeastSquares();
  LeastSquares(const LeastSquares&) = delete;
  LeastSquares& operator=(const LeastSquares&) = delete;

  ceres::Problem& problem() { return *problem_; }
  std::span<double> x() { return x_; }
  void SetX(std::span<const double> x);

  // Asked before each evaluation, those of a line search included: where `may_begin` is false,
  // EvaluationRefused is thrown, out of ceres::Solve too. problem() cannot be used afterwards.
  void SetGate(std::function<bool()> may_begin);
  const Counts& counts() const;

  // The counts in the budget's unit: residual evaluations, plus n (numeric: 2n) for each evaluation with
  // Jacobians, n the fit's free parameters.
  std::int64_t ChargedEvaluations() const;

  double Cost();  // ½ Σ ρ(r²) at x, NaN where it cannot be evaluated; counted as one residual evaluation

 private:
  class CountingCallback;

  void AddParameters(const ParameterBlock& block, double* values);

  std::vector<double> x_;
  std::vector<double*> blocks_;
  std::int64_t jacobian_charge_;
  std::vector<std::shared_ptr<ceres::Manifold>> manifolds_;  // kept alive for problem_
  std::shared_ptr<ceres::EvaluationCallback> state_;
  std::unique_ptr<CountingCallback> counting_;
  std::unique_ptr<ceres::Problem> problem_;
};

}  // namespace frond
