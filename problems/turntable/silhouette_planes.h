// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/turntable_rig.h"
#include "problems/turntable/turntable_view.h"

namespace frond {

// normal · x = offset, the normal (unit) pointing out of the object that the plane touches.
struct TangentPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
};

// The planes through the camera's centre and the upper and lower outline of the silhouettes, in the disk's
// frame: each touches the object (Cipolla and Giblin 2000). Where no window can be matched, at the top and
// the bottom of an object seen from the side, they still bound it. The outline is smoothed over 17 columns by
// parabolas; parts steeper than 60 degrees or at the image's border are left out. `views`: with masks.
std::vector<TangentPlane> PlanesOfSilhouettes(std::span<const TurntableView> views, const TurntableRig& rig,
                                              int threads);

}  // namespace frond
