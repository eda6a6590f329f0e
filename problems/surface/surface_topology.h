// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/nurbs_surface.h"

namespace frond {

// What a surface is made of one rectangle (u, v): a sheet, with or without holes; a tube, closed in u with a
// rim at both ends of v; a cup, closed in u with a pole at v's begin and a rim at its end; a sphere, closed
// in u with two poles.
enum class SurfaceTopology { kSheet, kTube, kCup, kSphere };

const char* SurfaceTopologyName(SurfaceTopology topology);  // "sheet", "tube", "cup", "sphere"

inline PoleEnds PolesOf(SurfaceTopology topology) {
  return {.begin = topology == SurfaceTopology::kCup || topology == SurfaceTopology::kSphere,
          .end = topology == SurfaceTopology::kSphere};
}

}  // namespace frond
