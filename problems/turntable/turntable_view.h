// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "models/raster.h"

namespace frond {

// A photograph of the object on the disk.
struct TurntableView {
  double angle = 0;         // of the disk, degrees, counter-clockwise seen from above
  Image image = {};         // grey
  ColourImage colour = {};  // of the same size; empty: the cloud is grey
  Mask mask = {};           // 1: object; empty: found (object_mask.h)
  std::string name = {};    // for messages: its file
};

}  // namespace frond
