// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/profiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace frond {
namespace {

// units[p]: the cost that counts as 1 on problem p; where it is infinite nobody solved p.
std::vector<StepCurve> ProfilesInUnits(const CostTable& costs, std::span<const double> units) {
  std::vector<StepCurve> profiles(SolverCount(costs));
  std::vector<double> ratios(costs.size());
  for (std::size_t solver = 0; solver < profiles.size(); ++solver) {
    for (std::size_t problem = 0; problem < costs.size(); ++problem) {
      const double cost = costs[problem][solver];
      // A solved problem stays solved where the ratio overflows.
      ratios[problem] =
          std::isinf(cost) ? cost : std::min(cost / units[problem], std::numeric_limits<double>::max());
    }
    profiles[solver] = EmpiricalDistribution(ratios);
  }
  return profiles;
}

}  // namespace

std::vector<StepCurve> PerformanceProfiles(const CostTable& costs) {
  SolverCount(costs);
  std::vector<double> best;
  for (const std::vector<double>& row : costs) {
    best.push_back(std::ranges::min(row));
    if (best.back() <= 0) throw std::invalid_argument("PerformanceProfiles: a cost is not positive");
  }
  return ProfilesInUnits(costs, best);
}

std::vector<StepCurve> DataProfiles(const CostTable& evaluations,
                                    std::span<const std::int64_t> parameter_counts) {
  SolverCount(evaluations);
  if (parameter_counts.size() != evaluations.size()) {
    throw std::invalid_argument("DataProfiles: not one parameter count a problem");
  }
  std::vector<double> units;
  for (std::size_t problem = 0; problem < evaluations.size(); ++problem) {
    if (parameter_counts[problem] < 1)
      throw std::invalid_argument("DataProfiles: a problem without parameters");
    if (std::ranges::min(evaluations[problem]) < 0) {
      throw std::invalid_argument("DataProfiles: evaluations are negative");
    }
    units.push_back(static_cast<double>(parameter_counts[problem]) + 1);
  }
  return ProfilesInUnits(evaluations, units);
}

}  // namespace frond
