// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"
#include "models/tessellation.h"
#include "problems/surface/distance_fit.h"

namespace frond {

// How far the noise of the points moves a fitted surface.
struct SurfaceUncertainty {
  double noise_sigma = 0;         // of a point along the normal: σ̂² = RSS / (m − degrees_of_freedom)
  double degrees_of_freedom = 0;  // tr(H⁻¹ H_data): fewer than the unknowns where fairness holds some
  std::vector<double> standard_deviation;  // along the normal, by place asked for
};

// With A the distance fit's rows at its minimum (one a point: along the normal), H_data = AᵀA, and
// H = H_data + fairness, hinge, margin and ridge, the estimate is to first order x̂ = x + H⁻¹Aᵀ(noise) and
//
//   Cov(x̂) = σ̂² H⁻¹ H_data H⁻¹
//
// for independent points with the same noise. The variance of the surface at (u, v) along its normal is
// aᵀ Cov a, a = nᵀ ∂S/∂x. Only that direction is given: rows along the normal say nothing of where control
// points lie along the surface, which fairness alone decides. The bias that fairness brings is not in it.
// `fitted`: the solution; `points` the ones it was fitted to; `options` those of the last solve; `places`:
// (u, v) in the domain, with the surface's unit `normals` there (at a pole S_u × S_v tells none). Throws
// FitError where H is singular.
SurfaceUncertainty EstimateUncertainty(std::span<const Eigen::Vector3d> points, const NurbsSurface& fitted,
                                       const DistanceFitOptions& options,
                                       std::span<const Eigen::Vector2d> places,
                                       std::span<const Eigen::Vector3d> normals, int threads);

// The mean over the area of a value at the vertices of a mesh.
double AreaMean(const SurfaceMesh& mesh, std::span<const double> value);

}  // namespace frond
