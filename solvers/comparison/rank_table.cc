// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/rank_table.h"

#include <stdexcept>

#include "solvers/comparison/mid_ranks.h"

namespace frond {

RankTable RankSolvers(const CostTable& costs) {
  const std::size_t solvers = SolverCount(costs);
  if (solvers < 2) throw std::invalid_argument("RankSolvers: a single solver");
  const double k = static_cast<double>(solvers), n = static_cast<double>(costs.size());
  RankTable table{std::vector<double>(solvers, 0.0), costs.size()};
  // Σ(rank − mean)² is (k³ − k)/12 without ties; each group of t tied solvers takes away (t³ − t)/12.
  double squares = 0;
  for (const std::vector<double>& row : costs) {
    const std::vector<double> ranks = MidRanks(row);
    for (std::size_t i = 0; i < solvers; ++i) {
      table.average_ranks[i] += ranks[i];
      squares += (ranks[i] - (k + 1) / 2) * (ranks[i] - (k + 1) / 2);
    }
  }
  for (double& rank : table.average_ranks) rank /= n;
  table.tie_correction = 12 * squares / (n * (k * k * k - k));
  return table;
}

}  // namespace frond
