// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "base/random.h"
#include "solvers/comparison/interval.h"

namespace frond {

// One run towards a target: the evaluations until it was reached or, without success, all that were spent.
struct RunLength {
  double evaluations;
  bool success;
};

// The expected running time of a solver that is restarted until it succeeds (Auger and Hansen 2005; Hansen et
// al. 2021, COCO): the evaluations of all runs over the number of successes; infinite without success. Throws
// std::invalid_argument for no runs, or evaluations that are negative or not finite.
double ExpectedRunningTime(std::span<const RunLength> runs);

// Its percentile bootstrap interval over the runs (bootstrap.h). The upper end is infinite where too many
// resamples hold no success.
Interval ExpectedRunningTimeInterval(std::span<const RunLength> runs, Random* random,
                                     double confidence = 0.95, int resamples = 1000);

}  // namespace frond
