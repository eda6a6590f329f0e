// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models/tessellation.h"

namespace frond {

// Pairs of triangles without a common corner that cut each other: an edge of one passes through the inside of
// the other. Candidates by a grid of cells.
int CountSelfIntersections(const SurfaceMesh& mesh);

}  // namespace frond
