// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/expected_running_time.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solvers/comparison/bootstrap.h"

namespace frond {

double ExpectedRunningTime(std::span<const RunLength> runs) {
  if (runs.empty()) throw std::invalid_argument("ExpectedRunningTime: no runs");
  double evaluations = 0, successes = 0;
  for (const RunLength& run : runs) {
    if (!(run.evaluations >= 0) || std::isinf(run.evaluations)) {
      throw std::invalid_argument("ExpectedRunningTime: evaluations are negative or not finite");
    }
    evaluations += run.evaluations;
    successes += run.success ? 1 : 0;
  }
  return successes > 0 ? evaluations / successes : std::numeric_limits<double>::infinity();
}

Interval ExpectedRunningTimeInterval(std::span<const RunLength> runs, Random* random, double confidence,
                                     int resamples) {
  std::vector<RunLength> drawn(runs.size());
  const auto time_of = [&](std::span<const std::size_t> indices) {
    for (std::size_t i = 0; i < indices.size(); ++i) drawn[i] = runs[indices[i]];
    return ExpectedRunningTime(drawn);
  };
  return BootstrapInterval(runs.size(), time_of, random, confidence, resamples);
}

}  // namespace frond
