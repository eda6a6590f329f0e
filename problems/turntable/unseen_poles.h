// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "problems/turntable/silhouette_planes.h"

namespace frond {

// What a cloud of a closed body leaves open about one end of the x axis, the origin being inside.
struct PoleCap {
  std::vector<Eigen::Vector3d> points = {};  // that close the hole, about as far apart as the cloud's
  double opening = 0;        // radians from the axis to the farthest of them, seen from the origin
  bool closable = true;      // false: the hole's rim does not bend inwards
  bool silhouettes = false;  // closed by these
};

// The end at −x (`end` −1) or +x (+1), where no point of the cloud is near: closed by the ellipsoid that the
// silhouettes' planes of within 50 degrees touch, if it meets the hole's rim; else by the quadric through the
// points between the hole and 30 degrees beyond it, which continues their bend. Of an ellipsoid either is
// exact. (Thin-plate energy alone would close the hole by a blunt cone, its tip anywhere.) `planes` may be
// empty; all in the points' frame.
PoleCap CloseUnseenPole(std::span<const Eigen::Vector3d> points, std::span<const TangentPlane> planes,
                        double end);

}  // namespace frond
