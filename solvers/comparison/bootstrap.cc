// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/bootstrap.h"

#include <stdexcept>
#include <vector>

#include "solvers/comparison/quantile.h"

namespace frond {

Interval BootstrapInterval(std::size_t sample_size, const ResampleStatistic& statistic, Random* random,
                           double confidence, int resamples) {
  if (sample_size == 0) throw std::invalid_argument("BootstrapInterval: an empty sample");
  if (random == nullptr) throw std::invalid_argument("BootstrapInterval: no random numbers");
  if (resamples < 1) throw std::invalid_argument("BootstrapInterval: no resamples");
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("BootstrapInterval: confidence is not in (0, 1)");
  }
  std::vector<std::size_t> indices(sample_size);
  std::vector<double> statistics(static_cast<std::size_t>(resamples));
  for (double& value : statistics) {
    for (std::size_t& index : indices) index = static_cast<std::size_t>(random->Below(sample_size));
    value = statistic(indices);
  }
  const double tail = (1 - confidence) / 2;
  return {Quantile(statistics, tail), Quantile(statistics, 1 - tail)};
}

}  // namespace frond
