// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/nurbs_curve.h"
#include "problems/skinning/section_planes.h"

namespace frond {

enum class SectionParametrisation { kBaseCurve, kChord, kCentripetal };

// Parameters in [0, 1) of a closed section's points, from `plane.start` counter-clockwise about its normal:
// the angle about its origin (the circle as base curve, acquisition paper, section 3.2.1.1), or cumulative
// chords (eqs 17, 19) in the order of that angle, 0 being where the polygon passes the start's direction.
std::vector<double> SectionParameters(std::span<const Eigen::Vector3d> points, const SectionPlane& plane,
                                      SectionParametrisation method);

// The closed curve of `control_points` distinct control points over uniform periodic knots on [0, 1] that is
// nearest to the points at their parameters, by least squares (eq. 22); a trace of fairness (the squared
// second differences of the control points, by 1e-6) carries it over gaps.
NurbsCurve FitSectionCurve(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                           int degree, int control_points);

}  // namespace frond
