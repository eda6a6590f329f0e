// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>

#include "base/random.h"
#include "models/raster.h"

namespace frond {

// What stands between the light and the file.
struct Sensor {
  int supersampling = 3;  // rays a pixel and direction
  double blur = 0.6;      // standard deviation of the lens's blur, pixels
  double noise = 1.5;     // standard deviation of a grey level, whatever the exposure
  bool colour = false;
};

struct Exposure {
  double gain = 1, offset = 0;  // grey level = gain · light + offset
};

using Light = Raster<std::array<float, 3>>;  // red, green, blue; grey levels before exposure

// Columns [x0, x1), rows [y0, y1).
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool Contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

// The mean of light(u, v) over supersampling² places in each pixel of `box` that is not in `done`. `light`
// has to be re-entrant.
void Collect(const PixelBox& box, const PixelBox& done, int supersampling, int threads,
             const std::function<std::array<float, 3>(double u, double v)>& light, Light* film);

// Blur, exposure, noise and whole grey levels from 0 to 255. `colour` is filled for a colour sensor, and
// `image` is then the luminance of it, as a reader of the file would find it; its noise is sensor.noise too.
struct Photograph {
  Image image = {};
  ColourImage colour = {};
};
Photograph Develop(Light film, const Sensor& sensor, const Exposure& exposure, Random& random);

// Of a colour, as ITU-R BT.601 and OpenCV weigh it.
float Luminance(const std::array<float, 3>& colour);

}  // namespace frond
