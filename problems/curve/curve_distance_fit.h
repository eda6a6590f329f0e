// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "models/curve_foot_point.h"
#include "problems/curve/curve_fit.h"
#include "solvers/fit_problem.h"

namespace frond {

struct CurveDistanceOptions {
  CurveUnknowns unknowns = CurveUnknowns::kControlPoints;
  CurveDistance distance = CurveDistance::kOrthogonal;
  CurveDerivatives derivatives = CurveDerivatives::kStructured;
  double fairness = 0;  // λ of λ N ∫|P″|² dt (of the control points' polynomial curve), t over [0, 1]
  double weight_ridge = 0;  // of Σ ω², in the unit of squared distances; only where weights are free
};

// The fit of a curve for any solver (MATH.md §1):
//
//   minimise  Σ_i |C(t_i) − Q_i|² + λN·E + ridge Σω²,
//
// t_i the foot point's parameter (orthogonal) or a given one (parametric). The parameter blocks are the
// distinct control points, weights as w = e^ω, the first one fixed (the scale of all is a gauge). One
// residual block a knot span: all its rows, compressed to D + 1. Foot points are brought up to date for all
// points before each evaluation, from their place at the last accepted iterate (the last one Jacobians were
// asked for).
class CurveDistanceFit : public FitProblem {
 public:
  // Views `points`; copies the rest. `parameters`: t_i, or near the feet on the start.
  CurveDistanceFit(std::span<const Eigen::Vector3d> points, std::vector<double> parameters,
                   const NurbsCurve& start, const CurveDistanceOptions& options);
  ~CurveDistanceFit() override;

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& blocks,
                                                         int threads) const override;
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  // Of the points alone: RMS distance ("rmse") and "max", at the fit's own feet.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

  NurbsCurve CurveAt(std::span<const double> x) const;

  // What a state needs of its fit; the fit outlives it.
  struct Shared;

 private:
  std::vector<ParameterBlock> parameters_;
  std::unique_ptr<const Shared> shared_;
};

// ∫ N_a″ N_c″ over each non-empty span, in a parameter whose domain has length 1.
std::vector<Eigen::MatrixXd> BendingGram(const SpanPolynomials& spans, double domain);

}  // namespace frond
