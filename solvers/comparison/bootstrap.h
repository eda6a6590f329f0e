// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "base/random.h"
#include "solvers/comparison/interval.h"

namespace frond {

// A statistic of the part of a sample that the indices name, with repetition. It may be infinite, not NaN.
using ResampleStatistic = std::function<double(std::span<const std::size_t> indices)>;

// The percentile bootstrap interval (Efron 1979; Efron and Tibshirani 1993, chapter 13): the quantiles of
// type 7 at (1 ∓ confidence)/2 of the statistic over `resamples` draws of sample_size indices below
// sample_size, with replacement. Infinite statistics sort last. The same state of *random gives the same
// interval. For paired samples let one index name a pair. Throws std::invalid_argument for sample_size 0,
// resamples < 1, confidence outside (0, 1), a null random, or a statistic that is NaN.
Interval BootstrapInterval(std::size_t sample_size, const ResampleStatistic& statistic, Random* random,
                           double confidence = 0.95, int resamples = 1000);

}  // namespace frond
