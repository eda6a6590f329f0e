// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/nurbs_surface.h"

namespace frond {

// Curvatures are 1/length and positive where the surface bends towards its normal S_u × S_v (a sphere with
// outward normals has −1/r). kappa1 ≥ kappa2; the directions are unit vectors in space with
// direction1 × direction2 = normal. At an umbilic they are any such pair.
struct SurfaceCurvature {
  double kappa1, kappa2;
  Eigen::Vector3d direction1, direction2;
  double Gaussian() const { return kappa1 * kappa2; }
  double Mean() const { return (kappa1 + kappa2) / 2; }
};

// From the two fundamental forms, in an orthonormal basis of the tangent plane (where the shape operator is
// symmetric). Empty where the surface has no normal, as at a collapsed edge.
std::optional<SurfaceCurvature> CurvatureOf(const SurfacePoint& point);

}  // namespace frond
