// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/nurbs_surface.h"

namespace frond {

// The surface over the given bases that minimises Σ |S(u_i, v_i) − Q_i|² + λ N · (thin-plate energy) at fixed
// parameters: one sparse factor of the scalar normal equations, three right-hand sides (MATH.md §1, point 4).
// `fairness` is λ, with (u, v) scaled to a domain of length 1; it carries the surface over cells without
// data. All weights 1; C¹ at `poles` (ControlNet). Throws FitError if the equations are singular.
NurbsSurface FitAtParameters(std::span<const Eigen::Vector3d> points,
                             std::span<const Eigen::Vector2d> parameters, const BSplineBasis& u,
                             const BSplineBasis& v, double fairness, PoleEnds poles = {});

}  // namespace frond
