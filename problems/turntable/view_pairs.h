// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/turntable_rig.h"

namespace frond {

// Two photographs of the disk that make one stereo pair, by their place in the list of views.
struct ViewPair {
  std::size_t left = 0;
  std::size_t right = 0;
};

struct ViewPairOptions {
  std::optional<double> phi = {};  // degrees between a pair's views; default: the smallest gap in the turn
  double tolerance = 0.1;          // share of phi by which a gap may differ from it
};

// All pairs of views that the disk turned by phi, in the order of their left view's angle in [0, 360). Turned
// round: 358 and 2 degrees are a pair of 4. The left view is the one whose camera stands to the left of the
// other's in the rig (turntable_rig.h), in whatever order the list has them. A view may belong to two pairs,
// as the left one of the first and the right one of the second (views at even steps of phi).
//
// `degrees`: the views' angles; `names`: for messages, one a view. Throws InputError where there are fewer
// than two views, an angle is not finite, two views stand at the same angle or a view has no partner.
std::vector<ViewPair> FindViewPairs(std::span<const double> degrees, std::span<const std::string> names,
                                    const TurntableRig& rig, const ViewPairOptions& options);

// The angle of `degrees` in [0, 360).
double NormalAngle(double degrees);

}  // namespace frond
