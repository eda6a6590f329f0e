// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"

namespace frond {

struct ParametricFitOptions {
  bool free_weights = false;  // by Ma's two steps; else all 1
  double fairness = 1e-10;    // λ
  int repetitions = 5;        // at most; of the base surface
  PoleEnds poles = {};        // kept C¹; not with free weights
};

struct ParametricFit {
  NurbsSurface surface;
  NurbsSurface base;                             // whose feet gave the last parameters
  std::vector<Eigen::Vector2d> parameters = {};  // the last ones, in [0, 1]², by point
  double squared_sum = 0;                        // Σ |S(u_i, v_i) − Q_i|² at them
  std::vector<double> history = {};              // of that sum: the first fit, then each repetition
};

// Least squares at fixed parameters, and Ma's base-surface parametrisation repeated (section 3.2.1 of the
// acquisition paper): the points' feet on the surface just fitted are the next parameters. Ends where a
// repetition gains less than 1 %, and keeps the best. Parameters are in [0, 1]². Throws FitError as the
// linear fits do.
ParametricFit FitAtFixedParameters(std::span<const Eigen::Vector3d> points,
                                   std::vector<Eigen::Vector2d> parameters, const BSplineBasis& u,
                                   const BSplineBasis& v, const ParametricFitOptions& options, int threads);

}  // namespace frond
