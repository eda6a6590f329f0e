// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/nurbs_surface.h"

namespace frond {

// Control points and weights of a surface over the given bases at fixed parameters (in [0, 1]², the domain
// scaled to length 1), by Ma's two steps (rational_sums.h): minimises Σ W_i² |S(u_i, v_i) − Q_i|², W_i the
// rational denominator, plus λN times the thin-plate energy of the weighted control points (about the points'
// mean) and, times their mean squared length, of the weights. `fairness` is λ; it carries the surface over
// cells without data, and with 0 the weights of points on a surface of this form are found to rounding.
// Throws FitError if the equations are singular, ConfigError above kMaxMaWeights control points (M is full).
inline constexpr int kMaxMaWeights = 2500;
NurbsSurface FitRationalAtParameters(std::span<const Eigen::Vector3d> points,
                                     std::span<const Eigen::Vector2d> parameters, const BSplineBasis& u,
                                     const BSplineBasis& v, double fairness);

}  // namespace frond
