// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solvers/comparison/rank_table.h"

namespace frond {

struct FriedmanTest {
  double chi_square;
  double p_value;           // of chi_square at k − 1 degrees of freedom
  double iman_davenport_f;  // at k − 1 and (k − 1)(N − 1) degrees of freedom; infinite where all ranks agree
};

// Whether k solvers rank alike over N problems: with average ranks R_j and the ties' correction c, χ² of
// Friedman (1937; Hollander and Wolfe 1999; with c = 1 Demšar 2006, section 3.2.2) and F of Iman and
// Davenport (1980) are
//
//   χ² = 12N/(k(k + 1)) Σ(R_j − (k + 1)/2)² / c,     F = (N − 1)χ²/(N(k − 1) − χ²).
//
// The p-value is asymptotic, good from N > 10 and k > 5 (Demšar 2006). Where every problem ties all solvers
// χ² is 0. Throws std::invalid_argument for fewer than 2 solvers or problems.
FriedmanTest Friedman(const RankTable& ranks);

}  // namespace frond
