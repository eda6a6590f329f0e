// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/nurbs_surface.h"

namespace frond {

// α₁ and α₂ of eqs. (10) and (11); α₁ + α₂ = 1, both ≥ 0.
struct LeafObjective {
  double rmse_share = 0.8;  // α₁
  double max_share = 0.2;   // α₂
};

// Eqs. (9) and (10) over some points. Lengths in the points' unit.
struct LeafError {
  double rmse = 0;
  double max = 0;        // MV
  double objective = 0;  // F = α₁·RMSE + α₂·MV
};

LeafError ErrorOf(std::span<const double> squared_distances, const LeafObjective& objective);

// Orthogonal distances by a global foot point search (FootPointSearch::kThorough), on up to `threads`
// threads.
LeafError MeasureLeaf(const NurbsSurface& surface, std::span<const Eigen::Vector3d> points,
                      const LeafObjective& objective, int threads = 1);

}  // namespace frond
