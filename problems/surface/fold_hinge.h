// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/surface_cells.h"
#include "problems/surface/control_net.h"

namespace frond {

// Keeps a surface from folding (MATH.md §1, "A fold hinge"). At 4 × 4 samples a knot cell, with the unit
// normal n₀ and the area density J₀ of a reference surface there, J = (S_u × S_v)·n₀ / J₀ is the area kept;
// where J < limit the residual scale · (limit − J) is added. Zero, and free, where nothing folds.
class FoldHinge {
 public:
  static constexpr int kSamples = 4;  // a cell and direction

  FoldHinge(const SurfaceCells& reference, double limit);

  int num_samples() const { return static_cast<int>(samples_.size()); }

  // Σ (scale · (limit − J)₊)² over the samples of `cell`.
  double SquaredResiduals(const SurfaceCells& cells, int cell, double scale) const;

  // Adds the rows of the active samples to the normal equations over the blocks of the cell
  // (block_size() values each; of h the upper triangle); returns their squared residuals. The derivative by
  // control point m is −(scale / J₀) [∂_uR_m (S_v × n₀) + ∂_vR_m (n₀ × S_u)], R_m the rational basis.
  double AddRows(const SurfaceCells& cells, int cell, double scale, const ControlNet& net,
                 const CellBlocks& layout, const std::vector<Eigen::Vector3d>& control_points,
                 const std::vector<double>& weights, Eigen::MatrixXd* h, Eigen::VectorXd* g) const;

  struct Sample {
    double u, v;
    Eigen::Vector3d normal;  // n₀ / J₀; zero where the reference is degenerate
  };
  const std::vector<Sample>& samples() const { return samples_; }  // kSamples² a cell, cell-major
  double limit() const { return limit_; }

 private:
  double limit_;
  std::vector<Sample> samples_;
};

}  // namespace frond
