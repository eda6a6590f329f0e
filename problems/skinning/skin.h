// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "models/knot_vector.h"
#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

struct SkinOptions {
  int degree = 3;          // along v
  int control_points = 0;  // along v, those of poles included; 0: as many as interpolate every section
  Parametrisation parametrisation = Parametrisation::kChord;  // of the control points' columns
  // Points that close the surface before the first and after the last section.
  std::optional<Eigen::Vector3d> first_pole = {}, last_pole = {};
};

struct Skin {
  NurbsSurface surface;   // u along the sections, v across them, both on [0, 1]
  std::vector<double> v;  // of the sections: S(u, v[l]) = C^l(u)
};

// The surface through section curves, acquisition paper, section 3.3.4: the sections made compatible, their v
// by the mean over the control points' columns (eqs 15–19), knots by averaging (A7), the weights from eq.
// (32) and then the control points from eq. (33). With fewer control points than that takes (knots by A8) the
// first and last section are kept and the others met in the least-squares sense of eqs (32) and (33).
//
// A pole is a row of coincident control points; the row beside it is P₀ + cos φ_i A + sin φ_i B, with which
// the surface has one tangent plane there. A pole counts as two rows: with L sections control_points is at
// most L + 2 · poles. Of an interpolating skin A and B follow the tangents of the skin without that
// condition.
//
// Throws InputError where there are fewer than degree + 1 rows or than the ends take (two for a pole, else
// one), more rows than sections allow, neighbouring sections that coincide, a pole beside open sections, or a
// pole with degree 1; FitError where eq. (32) gives a weight that is not
// positive.
Skin SkinCurves(std::span<const NurbsCurve> sections, const SkinOptions& options);

// φ_i of a periodic basis: the mean of the knots of function i that the control point belongs to, as a share
// of the period, times 2π.
double GrevilleAngle(const BSplineBasis& basis, int i);

}  // namespace frond
