// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problems/turntable/camera_film.h"
#include "problems/turntable/turntable_scene.h"

namespace frond {

// One photograph of the pear.
struct SyntheticView {
  double angle = 0;         // of the disk, radians
  Image image = {};         // whole grey levels, 0 … 255; of a colour view its luminance
  ColourImage colour = {};  // of a colour view
  Mask mask = {};           // 1 where the pixel's centre sees the pear
};

// The photograph with the disk at `angle` (radians): pinhole camera with distortion, lamp fixed in the
// camera's frame, the pear's shadow on the disk. `random` draws the noise.
SyntheticView RenderView(const TurntableScene& scene, const Sensor& sensor, const Exposure& exposure,
                         double angle, Random& random, int threads = 1);

}  // namespace frond
