// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/kd_tree.h"
#include "problems/skinning/centre_line.h"

namespace frond {

// How a skinned surface ends: with the outermost plane's section, with the rim of the data (which need not
// lie in a plane), or closed in a point.
enum class SectionEnd { kAuto, kPlane, kRim, kPole };

struct CloudEnd {
  SectionEnd kind = SectionEnd::kPlane;  // never kAuto
  double position = 0;                   // along the centre line: where the outermost plane may stand at most
  std::vector<Eigen::Vector3d> rim;      // kRim, counter-clockwise about the line
  Eigen::Vector3d pole = Eigen::Vector3d::Zero();  // kPole
  double pole_radius = 0;                          // kPole, the radius of curvature there
};

// What the end of a cloud looks like. kAuto takes kPole where the points of the last quarter leave no hole
// about the centre line (below 0.35 of their median distance from it), else kRim. The rim is made of the
// outermost point in each sector of about a spacing's width; sectors whose point lies more than half a
// spacing inside a smooth ring (a Fourier series of order 2 in the angle) are left out as gaps of the data,
// the others moved along the surface onto a ring of order 4: a ragged rim would fold the surface. The pole is
// the outermost point, on a quadric through its surroundings. `positions` are those of the points along the
// line. Throws InputError where a rim was asked for and less than half of the sectors have one.
CloudEnd FindEnd(std::span<const Eigen::Vector3d> points, const KdTree& tree, double spacing,
                 const CentreLine& line, std::span<const double> positions, bool first, SectionEnd wanted);

}  // namespace frond
