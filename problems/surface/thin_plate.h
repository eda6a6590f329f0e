// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/surface_cells.h"

namespace frond {

// The exact thin-plate Gram matrix of each knot cell: ∫∫ (B_uu² + 2 B_uv² + B_vv²) over the cell as a form in
// its (p + 1)(q + 1) coefficients (index a (q + 1) + b), with (u, v) scaled to a domain of length 1 in each
// direction; and `membrane` times that of the first derivatives, ∫∫ (B_u² + B_v²). The energy of a surface is
// Σ over cells and coordinates of Pᵀ G P.
//
// With poles, where u runs round a point, the term in B_uu counts 1 / max(.08, sin θ)² times as much and the
// mixed one the root of that, θ being the angle from the pole at the cell's middle: π v, or ½π v where there
// is but one (MATH.md §1, "Closed with poles", of whose rows these are the squares).
std::vector<Eigen::MatrixXd> ThinPlateGram(const SurfaceCells& cells, PoleEnds poles = {},
                                           double membrane = 0);

}  // namespace frond
