// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"
#include "problems/surface/surface_quality.h"

namespace frond {

// The errors of section 4 of the acquisition paper, eqs (34)–(39), over all points. Lengths in the points'
// unit.
struct SurfaceErrors {
  // |Q_i − S(s_i, t_i)| at given parameters; none where there are no parameters.
  std::optional<double> parametric_total, parametric_mean;  // (34), (35)
  double perpendicular_total = 0, perpendicular_mean = 0;   // the same at the feet (36), (37)
  // Distance over R_i, the foot's distance from a barycentre: of the iso-curve of constant v through it where
  // the surface is closed in u (by arc length), else of the surface inside its trim (by area).
  double relative_total = 0, relative_mean = 0;  // (38), (39); a share, not per cent
  double p50 = 0, p90 = 0, p95 = 0, p99 = 0;     // of the perpendicular distances
};

// `parameters`: in [0, 1]², scaled to the domain, by point; or empty. `distances`: of these points
// (MeasureDistances). `least_radius`: R_i is at least this (a spacing of the points, say), as at a pole,
// whose iso-curve is a point; where it is 0 still, the point counts with 0.
SurfaceErrors MeasureSurfaceErrors(std::span<const Eigen::Vector3d> points,
                                   std::span<const Eigen::Vector2d> parameters,
                                   const PointDistances& distances, const TrimmedSurface& surface,
                                   double least_radius, int threads);

// ∫ S dA / ∫ dA inside the trim, by a regular grid of 200 × 200 samples.
Eigen::Vector3d AreaCentroid(const TrimmedSurface& surface);

// ∫ C ds / ∫ ds of the iso-curve of constant v.
Eigen::Vector3d IsoCurveCentroid(const NurbsSurface& surface, double v);

}  // namespace frond
