// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "solvers/comparison/step_curve.h"

namespace frond {

// The distribution of run lengths (Hansen et al. 2021, COCO; Hoos and Stützle 1998): at x the share of runs,
// or of all pairs of a problem and a target, that were reached within x evaluations; infinite where never
// reached. Read it with ShareAt. It holds only up to the smallest budget of its runs. Throws
// std::invalid_argument for no run lengths, or one that is negative or NaN.
StepCurve RunLengthDistribution(std::span<const double> run_lengths);

}  // namespace frond
