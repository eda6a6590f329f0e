// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "models/raster.h"

namespace frond {

// How the object is told from its background. kAuto: a threshold (Otsu 1979); the background is the side on
// which most of the image's border lies. kDark, kLight: a threshold, the background's side given. kNone: all
// of the image is taken.
enum class BackgroundKind { kAuto, kDark, kLight, kNone };

struct ObjectMaskOptions {
  BackgroundKind background = BackgroundKind::kAuto;
  double opening = 2;          // radius, pixels: thinner parts (wires, glare) are taken away; 0: none
  double least_share = 0.001;  // of the image that the object must cover
};

// The largest connected part on the object's side of the threshold, opened, its holes filled. `name`: of the
// image, for messages. Throws InputError where the image has no contrast (black, white, saturated) or no
// object is found.
Mask FindObjectMask(const Image& image, const ObjectMaskOptions& options, const std::string& name);

// The silhouette's share of the image.
double MaskShare(const Mask& mask);

}  // namespace frond
