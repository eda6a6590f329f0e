// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "models/bspline_basis.h"

namespace frond {

// Row k: all functions of `basis` at parameters[k], in the domain.
Eigen::MatrixXd BasisMatrix(const BSplineBasis& basis, std::span<const double> parameters);

}  // namespace frond
