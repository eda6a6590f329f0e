// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/surface_cells.h"

namespace frond {

// The exact thin-plate Gram matrix of each knot cell: ∫∫ (B_uu² + 2 B_uv² + B_vv²) over the cell as a form in
// its (p + 1)(q + 1) coefficients (index a (q + 1) + b), with (u, v) scaled to a domain of length 1 in each
// direction. The energy of a surface is Σ over cells and coordinates of Pᵀ G P.
std::vector<Eigen::MatrixXd> ThinPlateGram(const SurfaceCells& cells);

}  // namespace frond
