// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "models/raster.h"

namespace frond {

// Inclusive bounds of the displacement (u, v): (x, y) of the left image is seen at (x + u, y + v) of the
// right one. Of a rectified pair u = −disparity and v = 0.
struct SearchRange {
  std::array<int, 2> u{0, 0};
  std::array<int, 2> v{0, 0};
};

// Whole-pixel displacements, and the correlation of the windows; NaN where no window was found.
struct IntegerDisplacements {
  Image u = {}, v = {};
  Image correlation = {};
};

// Coarse to fine: on each halved image, the displacement of the best zero-mean normalised correlation of 9×9
// windows among those of `range` (coarsest) or next to those of the coarser level round the pixel. Pixels
// outside the masks (empty: none) do not count. A displacement is kept where no pixel of a better correlation
// claims the same place of the right image. `finest`: 0 for the whole image, 1 to stop at the half, …; the
// displacements are in that level's pixels.
IntegerDisplacements CorrelatePyramid(const Image& left, const Image& right, const Mask& left_mask,
                                      const Mask& right_mask, const SearchRange& range, int finest,
                                      int threads);

// The level of the pyramid where the search begins: the smaller side still has 80 pixels there, or 32 where
// `range` has too many displacements to try on a larger image.
int CoarsestLevel(const Image& image, const SearchRange& range);

}  // namespace frond
