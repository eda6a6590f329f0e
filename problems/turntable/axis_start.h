// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "problems/turntable/axis_fit.h"

namespace frond {

// The board's pose in each view by itself; reads boards that may be upside down so that each turns from the
// view before it (by angle) by as much as the table does. Throws InputError naming a view that cannot be
// located.
std::vector<Eigen::Isometry3d> LocateBoards(const PinholeCamera& camera, std::vector<AxisView>* views);

// The direction about which the boards turn by the views' angles, right-handed: the geometric median
// (Weiszfeld) over all pairs of views, so that a wrong angle does not move it. Throws InputError where all
// angles are 0 or 180 degrees apart.
Eigen::Vector3d TurnDirection(const std::vector<AxisView>& views,
                              const std::vector<Eigen::Isometry3d>& poses);

// The axis of this direction and the board at 0 degrees that explain the views best.
AxisState AxisStart(const PinholeCamera& camera, const std::vector<AxisView>& views,
                    const std::vector<Eigen::Isometry3d>& poses, const Eigen::Vector3d& up);

}  // namespace frond
