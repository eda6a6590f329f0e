// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/bspline_basis.h"

namespace frond {

struct CurvePoint {
  Eigen::Vector3d position, d1, d2;
};

// A rational B-spline curve C(t) = Σ N_i(t) w_i P_i / Σ N_i(t) w_i in space (plane curves have z = 0).
class NurbsCurve {
 public:
  // Throws InputError as NurbsSurface does. No weights: all 1.
  NurbsCurve(BSplineBasis basis, std::vector<Eigen::Vector3d> control_points,
             std::vector<double> weights = {});

  const BSplineBasis& basis() const { return basis_; }
  const std::vector<Eigen::Vector3d>& control_points() const { return control_points_; }
  const std::vector<double>& weights() const { return weights_; }

  // t outside the domain is moved into it (wrapped or clamped) first.
  Eigen::Vector3d Evaluate(double t) const;
  CurvePoint EvaluateWithDerivatives(double t) const;

 private:
  BSplineBasis basis_;
  std::vector<Eigen::Vector3d> control_points_;
  std::vector<double> weights_;
};

}  // namespace frond
