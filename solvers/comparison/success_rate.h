// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "solvers/comparison/interval.h"

namespace frond {

// Wilson's score interval for a rate of which `successes` of `trials` were seen, without continuity
// correction (Wilson 1927; method 3 of Newcombe 1998): with p = successes/trials, n = trials and
// z = Φ⁻¹((1 + confidence)/2)
//
//   (p + z²/2n ± z √(p(1 − p)/n + z²/4n²)) / (1 + z²/n).
//
// It stays in [0, 1] and does not shrink to a point at 0 or n successes. Throws std::invalid_argument unless
// 0 ≤ successes ≤ trials, trials ≥ 1 and 0 < confidence < 1.
Interval WilsonInterval(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

}  // namespace frond
