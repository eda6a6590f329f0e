// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "problems/surface/control_net.h"

namespace frond {

// The definition of a distance fit's rows: one point's residual with its foot (u, v) held fixed, as the
// envelope theorem allows (MATH.md §1),
//
//   residual_i = d_iᵀ (S − Q),   S = Σ_k B_k e^{ω_k} P_k / Σ_k B_k e^{ω_k},
//
// for one to three unit directions d_i: the surface's normal for a foot inside the domain, two directions
// square to the edge's tangent on an edge, all three in a corner. Parameter blocks: those of the knot cell,
// in the order of `layout->blocks`, each P (3 values), ω (1) or P, ω (4) as the net has it.
struct DistanceResidual {
  std::span<const double> basis;  // B_k, the cell's (p + 1)(q + 1) products N_a(u) N_b(v)
  const CellBlocks* layout;
  const ControlNet* net;
  Eigen::Vector3d point;                                // Q
  Eigen::Matrix<double, Eigen::Dynamic, 3> directions;  // one a row

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    const int size = net->block_size();
    Eigen::Matrix<T, 3, 1> sum(T(0.0), T(0.0), T(0.0));
    T denominator(0.0);
    for (std::size_t k = 0; k < basis.size(); ++k) {
      using std::exp;
      const std::vector<BlockTerm>& terms = layout->terms[k];
      const std::size_t control_point = layout->control_points[k];
      T weight(net->start_weights()[control_point]);
      if (net->unknowns() != SurfaceUnknowns::kControlPoints) weight = exp(blocks[terms[0].block][size - 1]);
      const T factor = weight * basis[k];
      denominator += factor;
      for (int x = 0; x < 3; ++x) {
        if (net->unknowns() == SurfaceUnknowns::kWeights) {
          sum[x] += factor * net->start_points()[control_point][x];
        } else {
          for (const BlockTerm& term : terms) sum[x] += factor * term.factor * blocks[term.block][x];
        }
      }
    }
    for (Eigen::Index i = 0; i < directions.rows(); ++i) {
      residuals[i] = T(0.0);
      for (int x = 0; x < 3; ++x) residuals[i] += directions(i, x) * (sum[x] / denominator - point[x]);
    }
    return true;
  }
};

}  // namespace frond
