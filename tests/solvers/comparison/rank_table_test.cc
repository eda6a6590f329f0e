// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/rank_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/random.h"
#include "solvers/comparison/chi_square.h"
#include "solvers/comparison/friedman_test.h"
#include "solvers/comparison/mid_ranks.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Demšar (2006), table 6: C4.5, C4.5+m, C4.5+cf and C4.5+m+cf on 14 data sets, by the ranks that he prints.
const CostTable kDemsar{{4, 3, 2, 1},     {1, 2, 3, 4}, {4, 1, 2, 3},     {4, 1, 3, 2}, {4, 2, 3, 1},
                        {1, 2.5, 4, 2.5}, {3, 2, 4, 1}, {2.5, 2.5, 4, 1}, {4, 3, 2, 1}, {2.5, 2.5, 2.5, 2.5},
                        {4, 2.5, 1, 2.5}, {3, 2, 4, 1}, {4, 1, 2, 3},     {3, 1, 4, 2}};

TEST(MidRanks, OfTies_AreTheMeansOfTheirRanks) {
  EXPECT_EQ(MidRanks(std::array{7.0, 3.0, kInfinity, 3.0, kInfinity, 5.0, 3.0}),
            (std::vector<double>{5, 2, 6.5, 2, 6.5, 4, 2}));
  EXPECT_TRUE(MidRanks({}).empty());
  EXPECT_THROW(MidRanks(std::array{std::nan("")}), std::invalid_argument);
}

TEST(RankTable, OfDemsarsClassifiers_HasHisAverageRanks) {
  const RankTable table = RankSolvers(kDemsar);
  const std::array expected{3.143, 2.000, 2.893, 1.964};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(table.average_ranks[i], expected[i], 5e-4);
  EXPECT_EQ(table.problems, 14U);
  // Three pairs and one four of ties: 1 − (3 · 6 + 60)/(14 · 60).
  EXPECT_DOUBLE_EQ(table.tie_correction, 1 - 78.0 / 840);
}

TEST(RankTable, AverageRanksSumUpToTheirTotal) {
  Random random(14);
  for (const std::size_t solvers : {2U, 5U, 9U}) {
    CostTable costs(11, std::vector<double>(solvers));
    for (std::vector<double>& row : costs) {
      for (double& cost : row) cost = random.Uniform() < 0.3 ? kInfinity : std::floor(5 * random.Uniform());
    }
    const RankTable table = RankSolvers(costs);
    const double sum = std::accumulate(table.average_ranks.begin(), table.average_ranks.end(), 0.0);
    EXPECT_NEAR(sum, static_cast<double>(solvers * (solvers + 1)) / 2, 1e-12);
  }
}

TEST(RankTable, WithoutTies_NeedsNoCorrection) {
  EXPECT_DOUBLE_EQ(RankSolvers({{1, 5, 3}, {9, kInfinity, 2}}).tie_correction, 1);
}

TEST(RankTable, OfASingleSolver_Throws) {
  EXPECT_THROW(RankSolvers({{1}, {2}}), std::invalid_argument);
  EXPECT_THROW(RankSolvers({{1, std::nan("")}}), std::invalid_argument);
}

TEST(Friedman, OfDemsarsAverageRanks_MatchesHim) {
  // He does not correct for ties: χ² = 9.28, F = 3.69 at 3 and 39 degrees of freedom.
  RankTable table = RankSolvers(kDemsar);
  table.tie_correction = 1;
  const FriedmanTest test = Friedman(table);
  EXPECT_NEAR(test.chi_square, 9.28, 0.005);
  EXPECT_NEAR(test.iman_davenport_f, 3.69, 0.005);
  EXPECT_NEAR(test.p_value, 0.0258, 1e-4);
}

TEST(Friedman, WithTies_MatchesSciPy) {
  CostTable costs(12, std::vector<double>(5));
  for (int p = 0; p < 12; ++p) {
    for (int s = 0; s < 5; ++s) {
      costs[static_cast<std::size_t>(p)][static_cast<std::size_t>(s)] = (7 * p + 5 * s * s + p * s) % 11 + s;
    }
  }
  // scipy_reference.py, SciPy 1.10.1: scipy.stats.friedmanchisquare.
  const FriedmanTest test = Friedman(RankSolvers(costs));
  EXPECT_NEAR(test.chi_square, 5.419913419913422, 1e-12);
  EXPECT_NEAR(test.p_value, 0.24685935885249324, 1e-12);
}

TEST(Friedman, WhereAllProblemsRankAlike_IsAtItsLargest) {
  const FriedmanTest test = Friedman(RankSolvers({{1, 2, 3}, {4, 5, 6}, {2, 7, kInfinity}}));
  EXPECT_DOUBLE_EQ(test.chi_square, 6);  // N(k − 1)
  EXPECT_EQ(test.iman_davenport_f, kInfinity);
  EXPECT_DOUBLE_EQ(test.p_value, std::exp(-3));
}

TEST(Friedman, WhereAllSolversTie_FindsNothing) {
  const FriedmanTest test = Friedman(RankSolvers({{1, 1, 1}, {kInfinity, kInfinity, kInfinity}}));
  EXPECT_EQ(test.chi_square, 0);
  EXPECT_EQ(test.p_value, 1);
  EXPECT_EQ(test.iman_davenport_f, 0);
}

TEST(Friedman, OfOneProblem_Throws) {
  EXPECT_THROW(Friedman(RankSolvers({{1, 2, 3}})), std::invalid_argument);
}

TEST(ChiSquareUpperTail, MatchesSciPy) {
  struct Reference {
    double x;
    int degrees_of_freedom;
    double tail;
  };
  // scipy_reference.py, SciPy 1.10.1: scipy.stats.chi2.sf.
  for (const Reference& r :
       {Reference{0.5, 1, 0.47950012218695337}, Reference{3.2, 2, 0.2018965179946554},
        Reference{9.28, 3, 0.025790724198756772}, Reference{15.0, 8, 0.05914545983268393},
        Reference{60.0, 19, 3.869826300664181e-06}, Reference{400.0, 3, 2.2138865931011112e-86}}) {
    EXPECT_NEAR(ChiSquareUpperTail(r.x, r.degrees_of_freedom) / r.tail, 1, 1e-12) << r.x;
  }
}

TEST(ChiSquareUpperTail, FallsFromOneToZero) {
  for (const int degrees_of_freedom : {1, 2, 7, 10}) {
    EXPECT_EQ(ChiSquareUpperTail(0, degrees_of_freedom), 1);
    EXPECT_EQ(ChiSquareUpperTail(kInfinity, degrees_of_freedom), 0);
  }
  EXPECT_THROW(ChiSquareUpperTail(1, 0), std::invalid_argument);
  EXPECT_THROW(ChiSquareUpperTail(-1, 2), std::invalid_argument);
}

}  // namespace
}  // namespace frond
