// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "models/knot_vector.h"
#include "models/nurbs_surface.h"
#include "problems/leaf/point_set.h"

namespace frond {

// How a point set becomes a B-spline surface, Wu et al. 2021, section 2.3.5 and appendix B.
enum class LeafSurfaceAlgorithm {
  kAlgorithm1,     // parameters and knots of their own for each row, averaged afterwards; any point set
  kApproximation,  // Algorithm A1: mean parameters, one knot vector a direction, eq. (A8); ordered sets
  kInterpolation,  // Algorithm A1 through all points, eq. (A7); ordered sets, count = their number
};

struct LeafSurfaceOptions {
  LeafSurfaceAlgorithm algorithm = LeafSurfaceAlgorithm::kAlgorithm1;
  Parametrisation parametrisation = Parametrisation::kChord;
  int degree_u = 2, degree_v = 2;
  int count_u = 5, count_v = 5;  // control points across and along; interpolation takes the set's own numbers
};

// A B-spline curve of `basis` through the first and the last of `points`, nearest to the others at their
// parameters by least squares (Piegl and Tiller, section 9.4.1): its control points. With as many points as
// control points it interpolates. Throws InputError where there are fewer, or they leave one undetermined.
std::vector<Eigen::Vector3d> FitRow(std::span<const Eigen::Vector3d> points,
                                    std::span<const double> parameters, const BSplineBasis& basis);

// The surface over [0, 1]²: u across from the left margin to the right one, v along from base to tip; all
// weights 1. The tip's row (one point repeated) has no length: it is left out of the means of parameters and
// knots, and its curve's control points are that point. Throws ConfigError where algorithm, degrees and
// counts don't fit the point set, InputError as FitRow.
NurbsSurface FitLeafSurface(const PointSet& set, const LeafSurfaceOptions& options);

}  // namespace frond
