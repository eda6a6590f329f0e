// SPDX-License-Identifier: BSD-3-Clause
// A synthetic rectified pair whose disparity is known exactly: a random texture, sampled by its formula in
// both images, on a disparity that is linear in x and y.
#pragma once

#include <cstdint>

#include "models/raster.h"

namespace frond {

struct TexturedPairOptions {
  int width = 200, height = 120;
  double contrast = 20;  // standard deviation of the texture, grey levels, about a mean of 120
  double grain = 3;      // px: the texture's correlation falls off as exp(−½ (distance / grain)²)
  double disparity = 20, slope_x = 0.05,
         slope_y = 0.02;           // at the centre, and a pixel of the left image; slopes < 1
  double gain = 0.8, offset = 15;  // of the right image
  double noise = 1.5;              // grey levels, white, in both
  std::uint64_t seed = 1;
};

struct TexturedPair {
  TexturedPairOptions options;
  Image left, right;

  // True disparity at the left image's (x, y), px.
  double Disparity(double x, double y) const;
};

TexturedPair MakeTexturedPair(const TexturedPairOptions& options);

}  // namespace frond
