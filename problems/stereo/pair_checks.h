// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "models/raster.h"

namespace frond {

// Throws InputError, naming the image and the share, where the images differ in size, a mask does not fit its
// image or is empty, or an image is black (hardly a pixel of the object above grey level 10), saturated (more
// than a third of its pixels at 250 or above) or of one grey level.
void CheckPair(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
               const std::array<std::string, 2>& names);

// Throws InputError where `disparity` (NaN: none) is negative nearly everywhere: of cameras side by side
// that look the same way it never is, so the images are swapped.
void CheckSides(const Image& disparity, const std::array<std::string, 2>& names);

}  // namespace frond
