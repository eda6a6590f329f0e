// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/cost_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace frond {

std::size_t SolverCount(const CostTable& costs) {
  if (costs.empty() || costs.front().empty())
    throw std::invalid_argument("a cost table without problems or solvers");
  for (const std::vector<double>& row : costs) {
    if (row.size() != costs.front().size())
      throw std::invalid_argument("a cost table with rows of different lengths");
    if (std::ranges::any_of(row, [](double cost) { return std::isnan(cost); })) {
      throw std::invalid_argument("a cost table with a NaN");
    }
  }
  return costs.front().size();
}

}  // namespace frond
