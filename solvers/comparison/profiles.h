// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/comparison/cost_table.h"
#include "solvers/comparison/step_curve.h"

namespace frond {

// Performance profiles (Dolan and Moré 2002, section 2), a curve a solver: ρ_s(τ) is the share of problems p
// with t_ps ≤ τ min over s' of t_ps'. So ρ_s(1) is the share of problems on which s was the best or tied with
// it, and the last share that of the problems it solved. A problem that no solver solved counts for none but
// stays in the denominator. Of more than two solvers the profiles tell the best, not the second (Gould
// and Scott 2016). Throws std::invalid_argument for a broken table (cost_table.h) or a cost that is not
// positive.
std::vector<StepCurve> PerformanceProfiles(const CostTable& costs);

// Data profiles (Moré and Wild 2009, section 2), a curve a solver: d_s(κ) is the share of problems solved
// within κ(n_p + 1) evaluations, n_p = parameter_counts[p]: κ counts simplex gradients. Throws
// std::invalid_argument for a broken table, negative evaluations, or counts that are fewer than 1 or not one
// a problem.
std::vector<StepCurve> DataProfiles(const CostTable& evaluations,
                                    std::span<const std::int64_t> parameter_counts);

}  // namespace frond
