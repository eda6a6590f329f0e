// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "problems/skinning/centre_line.h"
#include "problems/skinning/section_ends.h"
#include "problems/skinning/section_planes.h"

namespace frond {

// `count` planes across the line between two ends, in order, with the line's tangents as normals. Between
// plane ends and rims they stand equally far apart along the line, the outermost on plane ends and half a
// step inside rims. With a pole they stand equally far apart along the surface's mean profile instead, so
// that the cap is not left to one section; the last one stands away from the pole, where sections become
// tangent to the surface.
std::vector<SectionPlane> PlanesAlong(const CentreLine& line, std::span<const Eigen::Vector3d> points,
                                      std::span<const double> positions, const CloudEnd& first,
                                      const CloudEnd& last, int count, double spacing);

}  // namespace frond
