// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace frond {

// Problems × solvers: what each solver spent, or reached, on each problem. Less is better; +∞ is a failure.
using CostTable = std::vector<std::vector<double>>;

// The number of solvers. Throws std::invalid_argument for no problems, no solvers, rows of different lengths
// or a NaN.
std::size_t SolverCount(const CostTable& costs);

}  // namespace frond
