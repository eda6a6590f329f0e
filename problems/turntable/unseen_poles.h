// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace frond {

// What a cloud of a closed body leaves open about one end of the x axis, the origin being inside.
struct PoleCap {
  std::vector<Eigen::Vector3d> points = {};  // that close the hole, about as far apart as the cloud's
  double opening = 0;    // radians from the axis to the farthest of them, seen from the origin
  bool closable = true;  // false: the hole's rim does not bend inwards
};

// The end at −x (`end` −1) or +x (+1): the quadric
//   y² + z² + a (y² − z²) + b yz + c y + d z + e x + f x² + g xy + h xz + k = 0
// through the points between the hole and 30 degrees beyond it (least squares), where no point of the cloud
// is near. A sphere's and an ellipsoid's cap comes out exactly. Thin-plate energy alone would close the hole
// by a blunt cone, its tip anywhere.
PoleCap CloseUnseenPole(std::span<const Eigen::Vector3d> points, double end);

}  // namespace frond
