// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "solvers/comparison/cost_table.h"

namespace frond {

// How k solvers rank over N problems.
struct RankTable {
  std::vector<double> average_ranks;  // a solver each, 1 the best; their sum is k(k + 1)/2
  std::size_t problems;               // N
  // 1 − Σ(t³ − t)/(N(k³ − k)) over all groups of t tied solvers: 1 without ties, 0 where all always tie.
  double tie_correction = 1;
};

// Ranks the solvers on each problem, the least cost first, ties (failures too) sharing mid-ranks
// (mid_ranks.h), and averages over the problems. Throws std::invalid_argument for a broken table
// (cost_table.h) or a single solver.
RankTable RankSolvers(const CostTable& costs);

}  // namespace frond
