// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>

#include <memory>
#include <vector>

#include "solvers/fit_problem.h"

namespace frond {

// Ceres's trust region cuts a step off at the bounds after it was computed without them. Where the step
// points into a corner of the box nothing of it is left, and Ceres reports convergence at a point that is not
// a minimum: Rosenbrock's with x, y ≤ ½ ends at (½, ½) instead of (½, ¼). The cure is an active set: values
// that lie on a bound and whose gradient pushes them beyond it are held there, and the solve goes on over the
// others.
class ActiveBounds {
 public:
  // Both must outlive this.
  ActiveBounds(const FitProblem& fit, LeastSquares* least_squares);

  // Holds the values that are active at the current x, and no others; true where that changed anything, so
  // that another solve is due. Costs an evaluation with Jacobians if any value lies on a bound. Blocks on
  // manifolds are left to Ceres.
  bool Update();

 private:
  struct Block {
    double* values;
    const ParameterBlock* parameters;
    std::vector<int> held;  // indices, ascending
  };

  void Hold(const std::vector<int>& indices, Block* block);

  LeastSquares* least_squares_;
  std::vector<Block> blocks_;  // those with bounds
  std::vector<std::unique_ptr<ceres::Manifold>> manifolds_;
};

}  // namespace frond
