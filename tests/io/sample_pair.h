// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/raster.h"

namespace frond {

// A speckle pattern without end, known exactly between pixels: grey levels 20 to 235, detail of 5 pixels and
// more.
double SampleSpeckle(double x, double y);

// A rectified pair of a slanted plane: the left image's disparity is offset + slope · x.
struct SamplePair {
  Image left, right, disparity;
};
SamplePair MakeSamplePair(int width, int height, double offset, double slope);

}  // namespace frond
