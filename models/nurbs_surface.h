// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/bspline_basis.h"

namespace frond {

// A point of a surface with its derivatives through second order, and the unit normal of S_u × S_v (zero
// where the two are parallel or one vanishes to rounding, 1e-13 of the largest derivative).
struct SurfacePoint {
  Eigen::Vector3d position, du, dv, duu, duv, dvv;
  Eigen::Vector3d Normal() const;
};

// A rational tensor-product B-spline surface, eq. (4) of Wu et al. 2021:
//   S(u, v) = Σ_i Σ_j N_i(u) N_j(v) w_ij P_ij / Σ_i Σ_j N_i(u) N_j(v) w_ij.
// Control points and weights are stored u-major: index i * count(v) + j, i along u. A periodic direction
// repeats its first `degree` control points at the end.
class NurbsSurface {
 public:
  // Throws InputError unless the counts fit the bases, all values are finite, all weights positive, and a
  // periodic direction's repeated control points agree (they are made equal to the bit). No weights: all 1.
  NurbsSurface(BSplineBasis u, BSplineBasis v, std::vector<Eigen::Vector3d> control_points,
               std::vector<double> weights = {});

  const BSplineBasis& u() const { return u_; }
  const BSplineBasis& v() const { return v_; }
  int count_u() const { return u_.num_control_points(); }
  int count_v() const { return v_.num_control_points(); }
  const std::vector<Eigen::Vector3d>& control_points() const { return control_points_; }
  const std::vector<double>& weights() const { return weights_; }
  const Eigen::Vector3d& control_point(int i, int j) const { return control_points_[Index(i, j)]; }
  double weight(int i, int j) const { return weights_[Index(i, j)]; }
  bool IsRational() const;  // false where all weights are equal

  // Parameters outside the domain are moved into it (wrapped or clamped) first.
  Eigen::Vector3d Evaluate(double u, double v) const;
  SurfacePoint EvaluateWithDerivatives(double u, double v) const;

  // The diagonal of the control points' bounding box: the length that tolerances are relative to.
  double Size() const;

 private:
  std::size_t Index(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(count_v()) + static_cast<std::size_t>(j);
  }

  BSplineBasis u_, v_;
  std::vector<Eigen::Vector3d> control_points_;
  std::vector<double> weights_;
};

// Which ends of v are poles: u is periodic and the end's row of control points is one point.
struct PoleEnds {
  bool begin = false, end = false;
  bool any() const { return begin || end; }
};

// A closed polygon in (u, v); the last point is joined to the first, which is not repeated.
using TrimLoop = std::vector<Eigen::Vector2d>;

// A surface and the part of it that counts: inside the first loop and outside the others; all of it if none.
struct TrimmedSurface {
  NurbsSurface surface;
  std::vector<TrimLoop> trim;
};

// Where the loops cross the line of constant u, rising in v: a point of the line is inside where an odd
// number of crossings lies below it.
std::vector<double> TrimCrossings(const std::vector<TrimLoop>& trim, double u);

// Even-odd rule over all loops; true everywhere if there are none.
bool InsideTrim(const std::vector<TrimLoop>& trim, const Eigen::Vector2d& uv);

}  // namespace frond
