// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/friedman_test.h"

#include <limits>
#include <stdexcept>

#include "solvers/comparison/chi_square.h"

namespace frond {

FriedmanTest Friedman(const RankTable& ranks) {
  if (ranks.average_ranks.size() < 2 || ranks.problems < 2) {
    throw std::invalid_argument("Friedman: fewer than 2 solvers or problems");
  }
  const double k = static_cast<double>(ranks.average_ranks.size()), n = static_cast<double>(ranks.problems);
  double squares = 0;
  for (const double rank : ranks.average_ranks) squares += (rank - (k + 1) / 2) * (rank - (k + 1) / 2);
  FriedmanTest test{0, 1, 0};
  if (ranks.tie_correction > 0) test.chi_square = 12 * n / (k * (k + 1)) * squares / ranks.tie_correction;
  test.p_value = ChiSquareUpperTail(test.chi_square, static_cast<int>(ranks.average_ranks.size()) - 1);
  // χ² is N(k − 1) where all problems rank alike, up to rounding.
  const double room = n * (k - 1) - test.chi_square;
  test.iman_davenport_f =
      room > 1e-12 * n * (k - 1) ? (n - 1) * test.chi_square / room : std::numeric_limits<double>::infinity();
  return test;
}

}  // namespace frond
