// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "problems/curve/curve_distance_fit.h"
#include "problems/curve/curve_fit.h"

namespace frond {

// The staged fit of one curve to points in order, on one budget. Options, solver, budget and context must
// outlive it.
class CurveStages {
 public:
  CurveStages(const CurveFitOptions& options, const Solver& solver, const Budget& budget,
              const SolveContext& context);

  // From the linear fit at the location parameters and, where weights are free, from Ma's: the first stage
  // runs from each, and the better goes on. Where nothing else is asked for, log-weights and bending have
  // priors on the scale of s², the variance of the distances left by the stage before: deviation 1 for each
  // log-weight (a ridge s² Σω²), and n s² (∫|C″|² / E), n control points, E the energy of a smooth linear
  // fit. Of data that the curve meets s² falls to nothing, stage by stage, and with it the bias. With free
  // weights the stages first run without the prior on bending, and that curve is taken if it is exact (1e-9
  // of the extent), or nearer to the points where the budget ends the other stages. A stage without budget
  // leaves the curve as it is.
  NurbsCurve Fit(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& parameters,
                 const BSplineBasis& basis);

  const SolverReport& report() const { return report_; }                 // of all stages together
  const std::vector<double>& parameters() const { return parameters_; }  // last feet, by point

 private:
  struct Result {
    NurbsCurve curve;
    double rmse, objective;
  };
  Result RunStages(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& parameters,
                   const BSplineBasis& basis, bool by_noise);
  Result RunStage(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& parameters,
                  const NurbsCurve& start, double fairness, double ridge);
  void FollowFeet(const std::vector<Eigen::Vector3d>& points, const NurbsCurve& curve);

  const CurveFitOptions& options_;
  const Solver& solver_;
  const Budget& budget_;
  const SolveContext& context_;
  std::vector<double> parameters_;
  SolverReport report_;
};

}  // namespace frond
