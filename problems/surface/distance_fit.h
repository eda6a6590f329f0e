// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"
#include "problems/surface/control_net.h"
#include "problems/surface/margin_rows.h"
#include "solvers/fit_problem.h"
#include "solvers/robust_loss.h"

namespace frond {

// kStructured: rows from moments of the feet (cell_moments.h). kAutodiff: every row from DistanceResidual
// through Ceres's auto-diff, the definition; equal, and slow.
enum class DistanceDerivatives { kStructured, kAutodiff };

struct DistanceFitOptions {
  SurfaceUnknowns unknowns = SurfaceUnknowns::kControlPoints;
  DistanceDerivatives derivatives = DistanceDerivatives::kStructured;
  double fairness = 1e-10;       // λ of λ N · (thin-plate energy), (u, v) scaled to [0, 1]²
  double membrane = 0;           // of the first derivatives' energy, beside 1 of the second ones'
  double length_scale = 1;       // that terms in mm² below are measured in, so that the unit does not matter
  double hinge = 1;              // μ in length_scale²; 0: no hinge
  double hinge_limit = 0.3;      // δ, share of the reference's area density
  double weight_ridge = 2.5e-4;  // of Σω², times N length_scale²; only where weights are free
  RobustLoss loss;               // of each point's distance
  // Emphasis β on large distances: a point's cost d² becomes d² (1 + β d² / peak_scale²), between least
  // squares and least maximum. 0: none. Not with a robust loss.
  double peak_emphasis = 0;
  double peak_scale = 1;
  std::optional<MarginOptions> margin;  // rows that conform the edges to the boundary ring
  std::vector<std::vector<int>> tied;   // groups of control points that stay one point
  PoleEnds poles = {};                  // kept C¹ (ControlNet); only with control points as unknowns
};

// The orthogonal distance fit of a surface (MATH.md §1), written for any solver:
//
//   minimise  Σ_i ρ(d_i²) + λN·E + hinge + margin,   d_i the distance of point i to its foot point.
//
// The parameter blocks are the control net's. One residual block a knot cell: all rows whose foot lies there,
// compressed to D + 1. Foot points are brought up to date for all points before each evaluation, from their
// place at the last accepted iterate (the last one Jacobians were asked for); the first ones by global
// search.
class SurfaceDistanceFit : public FitProblem {
 public:
  // Views `points`; copies the rest. `reference` is the surface whose normals and area densities the hinge
  // keeps (the start, usually). `feet`: (u, v) near each point's foot on the start, or empty: found by
  // search.
  SurfaceDistanceFit(std::span<const Eigen::Vector3d> points, const NurbsSurface& start,
                     const NurbsSurface& reference, DistanceFitOptions options, int threads,
                     std::vector<Eigen::Vector2d> feet = {});
  ~SurfaceDistanceFit() override;

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& blocks,
                                                         int threads) const override;
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  // Of the points alone: RMS distance ("rmse") and "max", by the fit's own feet.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

  NurbsSurface SurfaceAt(std::span<const double> x) const;
  const ControlNet& net() const;

  // What a state needs of its fit; the fit outlives it.
  struct Shared;

 private:
  std::vector<ParameterBlock> parameters_;
  std::unique_ptr<const Shared> shared_;
};

}  // namespace frond
