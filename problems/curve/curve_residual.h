// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "problems/curve/curve_fit.h"

namespace frond {

// The definition of a curve fit's rows: one point's residual with its parameter t held fixed (location
// parameters are; at a foot point the envelope theorem allows it, MATH.md §1),
//
//   residual_i = d_iᵀ (C − Q),   C = Σ_a N_a e^{ω_a} P_a / Σ_a N_a e^{ω_a},
//
// for two unit directions d_i square to the tangent at a foot inside the domain, all three elsewhere.
// Parameter blocks: the degree + 1 control points of the span, each P (3 values), ω (1) or P, ω (4).
struct CurveResidual {
  std::span<const double> basis;  // N_a(t)
  CurveUnknowns unknowns;
  std::span<const Eigen::Vector3d> control_points;  // P_a and w_a where they are held
  std::span<const double> weights;
  Eigen::Vector3d point;                                      // Q
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3> directions;  // one a row

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    using std::exp;
    Eigen::Matrix<T, 3, 1> sum(T(0.0), T(0.0), T(0.0));
    T denominator(0.0);
    for (std::size_t a = 0; a < basis.size(); ++a) {
      T weight(weights[a]);
      if (unknowns == CurveUnknowns::kWeights) weight = exp(blocks[a][0]);
      if (unknowns == CurveUnknowns::kBoth) weight = exp(blocks[a][3]);
      const T factor = weight * basis[a];
      denominator += factor;
      for (int x = 0; x < 3; ++x) {
        if (unknowns == CurveUnknowns::kWeights) {
          sum[x] += factor * control_points[a][x];
        } else {
          sum[x] += factor * blocks[a][x];
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
