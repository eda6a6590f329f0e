// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"

namespace frond {

// The mask without the pixels nearer to its outside, in steps to the four neighbours, than `width` (0: the
// mask itself; an empty mask stays empty). The image's border is no edge of an object. Pixels at a silhouette
// mix object and background, and match the silhouette, which is not the same line of the object in both
// images.
Mask WithoutEdge(const Mask& mask, int width);

}  // namespace frond
