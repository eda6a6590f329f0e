// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace frond {

// Nemenyi's critical difference (Nemenyi 1963; Demšar 2006, section 3.2.2): two of k solvers differ at the
// level `significance`, corrected for all pairs, if their average ranks over N problems differ by at least
//
//   q/√2 · √(k(k + 1)/(6N)),
//
// q the upper quantile of the studentised range at `significance` (studentized_range.h). Throws
// std::invalid_argument for solvers < 2, problems < 1 or significance outside (0, 1).
double NemenyiCriticalDifference(std::size_t solvers, std::size_t problems, double significance = 0.05);

// The bars of a critical-difference diagram (Demšar 2006, figure 1): the maximal groups of two solvers or
// more whose average ranks all lie within less than the critical difference, as indices of solvers, best
// first in a group, and the group with the best solver first. A solver in no group differs from all others.
// Throws std::invalid_argument for a rank that is not finite or a critical difference that is not positive.
std::vector<std::vector<std::size_t>> IndistinguishableGroups(std::span<const double> average_ranks,
                                                              double critical_difference);

}  // namespace frond
