// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/nurbs_curve.h"
#include "problems/curve/curve_fit.h"

namespace frond {

// The errors of Moustakides et al., section 4, in the data's unit.
struct CurveErrors {
  double rmse = 0, max = 0, mean = 0, p95 = 0;             // perpendicular distances
  double perpendicular_total = 0, perpendicular_mean = 0;  // eqs (34) and (35) at the foot points, eq. (36)
  double parametric_total = 0, parametric_mean = 0;        // eqs (34) and (35) at the location parameters
  double relative_total = 0, relative_mean = 0;            // eqs (38) and (39), shares of R
  double length = 0;
  Eigen::Vector3d barycentre =
      Eigen::Vector3d::Zero();  // of the curve as a wire; R_i: from there to the foot
};

CurveErrors MeasureCurveErrors(std::span<const Eigen::Vector3d> points, const CurveFit& fit);

}  // namespace frond
