// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/run_length_distribution.h"

#include <algorithm>
#include <stdexcept>

namespace frond {

StepCurve RunLengthDistribution(std::span<const double> run_lengths) {
  if (!std::ranges::all_of(run_lengths, [](double length) { return length >= 0; })) {
    throw std::invalid_argument("RunLengthDistribution: a run length is negative or NaN");
  }
  return EmpiricalDistribution(run_lengths);
}

}  // namespace frond
