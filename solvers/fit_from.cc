// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/fit_from.h"

#include <algorithm>
#include <stdexcept>

namespace frond {

FitFrom::FitFrom(const FitProblem& fit, std::span<const double> start)
    : fit_(fit), parameters_(fit.parameters()) {
  if (start.size() != static_cast<std::size_t>(fit.NumParameters())) {
    throw std::invalid_argument("a start of the wrong length");
  }
  std::size_t offset = 0;
  for (ParameterBlock& block : parameters_) {
    if (!block.constant) std::copy_n(&start[offset], block.start.size(), block.start.begin());
    offset += block.start.size();
  }
}

}  // namespace frond
