// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace frond {

struct RankedSeries {
  std::string label;
  double mean_rank = 0;
};

// Demšar's critical-difference diagram (2006, figure 1) as an SVG document: each solver at its mean rank, the
// best (1) left; a bar joins the solvers of each of `groups` (indices into `solvers`), which ranks cannot
// tell apart; above, the critical difference to scale. Empty where there are fewer than two solvers or a rank
// is not finite.
std::string CriticalDifferenceSvg(const std::vector<RankedSeries>& solvers, double critical_difference,
                                  const std::vector<std::vector<std::size_t>>& groups);

}  // namespace frond
