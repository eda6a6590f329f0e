// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/more_wild_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "problems/standard/more_wild_functions.h"
#include "problems/standard/more_wild_set.h"
#include "tests/problems/standard/fit_checks.h"

namespace frond {
namespace {

TEST(MoreWildSet, Rows_EqualDfoDat) {
  const std::filesystem::path path = std::filesystem::path(FROND_SHARED_DATA) / "dfo" / "dfo.dat";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << "no " << path;
  for (const MoreWildRow& row : MoreWildRows()) {
    int function, n, m, start_exponent;
    ASSERT_TRUE(file >> function >> n >> m >> start_exponent);
    EXPECT_EQ(row.function, function);
    EXPECT_EQ(row.n, n);
    EXPECT_EQ(row.m, m);
    EXPECT_EQ(row.start_exponent, start_exponent);
  }
  std::string rest;
  EXPECT_FALSE(file >> rest) << "more rows than 53";
}

TEST(MoreWildSet, Names_SayRowFunctionSizeAndStart) {
  const std::vector<TestProblem> problems = Problems("more_wild");
  ASSERT_EQ(problems.size(), 53u);
  EXPECT_EQ(problems[0].name, "mw01_linear_full_rank_9");
  EXPECT_EQ(problems[1].name, "mw02_linear_full_rank_9_x10");
  EXPECT_EQ(problems[24].name, "mw25_box_3d_3");
  EXPECT_EQ(problems[52].name, "mw53_heart8ls_8_x10");
}

// Σ r² at the 53 starts as published with the supplement (POptUS/BenDFO, data/testout.dat, "smooth"), among
// them Moré, Garbow and Hillstrom's 24.2 (Rosenbrock), 2500 (helical valley), 215 (Powell) and 400.5.
TEST(MoreWildFit, SumOfSquares_AtStarts_IsThePublishedOne) {
  const std::vector<double> published = {
      7.20000e+01, 1.12500e+03, 1.16542e+07, 1.16859e+09, 4.98920e+06, 5.00936e+08, 2.42000e+01, 1.79577e+06,
      2.50000e+03, 1.06000e+04, 2.15000e+02, 1.61540e+06, 4.00500e+02, 1.54575e+08, 4.16817e+01, 1.30623e+03,
      5.31317e-03, 1.69361e+09, 1.64308e+01, 2.32337e+06, 2.69042e+01, 8.15888e+06, 7.36782e+01, 2.05938e+07,
      1.03115e+03, 4.17131e+03, 7.92669e+06, 3.08106e+11, 4.64282e-02, 3.37706e-02, 3.86177e-02, 2.88830e-02,
      3.37633e-02, 2.67406e-02, 2.73248e+02, 1.61741e+01, 2.09342e+00, 1.99685e+02, 9.04000e+02, 1.35600e+03,
      1.58200e+03, 1.80800e+03, 5.65000e+01, 7.05625e+01, 9.86875e+01, 2.53908e+09, 6.87380e+12, 3.36796e+09,
      3.73513e+09, 3.99107e+09, 1.13001e+13, 9.38567e+00, 3.36582e+10};
  const std::span<const MoreWildRow> rows = MoreWildRows();
  ASSERT_EQ(rows.size(), published.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MoreWildFit fit(rows[i]);
    const double last_digit = std::pow(10, std::floor(std::log10(published[i])) - 5);
    EXPECT_NEAR(2 * fit.Objective(fit.StartVector()), published[i], 0.50001 * last_digit) << "row " << i + 1;
  }
}

TEST(MoreWildFit, Objective_IsTheCeresCost) {
  for (const MoreWildRow& row : MoreWildRows()) {
    SCOPED_TRACE(row.function);
    const MoreWildFit fit(row);
    ExpectObjectiveIsCeresCost(fit, fit.StartVector());
  }
}

TEST(MoreWildFit, Gradient_AtStarts_MatchesDifferences) {
  for (const MoreWildRow& row : MoreWildRows()) {
    SCOPED_TRACE(row.function);
    const MoreWildFit fit(row);
    ExpectGradientMatchesDifferences(fit, fit.StartVector());
  }
}

TEST(MoreWildFit, StartBox_IsTheStartWithItsSizeOrOneAround) {
  const MoreWildFit meyer({10, 3, 16, 0});  // (0.02, 4000, 250)
  EXPECT_EQ(meyer.parameters()[0].start_lower, (std::vector<double>{0.02 - 1, 0, 0}));
  EXPECT_EQ(meyer.parameters()[0].start_upper, (std::vector<double>{0.02 + 1, 8000, 500}));
  const MoreWildFit far({7, 2, 2, 1});  // 10 · (0.5, −2)
  EXPECT_EQ(far.parameters()[0].start_lower, (std::vector<double>{0, -40}));
  EXPECT_EQ(far.parameters()[0].start_upper, (std::vector<double>{10, 0}));
}

TEST(MoreWildFunctions, HelicalValley_IsContinuousBehindTheAxisAndAcrossIt) {
  const auto theta = [](double x1, double x2) {
    const double x[3] = {x1, x2, 0};
    double r[3];
    more_wild::HelicalValley(x, r);
    return -r[0] / 100;
  };
  EXPECT_NEAR(theta(-1, 1e-9), 0.5, 1e-9);
  EXPECT_NEAR(theta(-1, -1e-9), 0.5, 1e-9);
  EXPECT_NEAR(theta(0, 2), 0.25, 1e-15);
  EXPECT_NEAR(theta(1e-9, 2), 0.25, 1e-9);
  EXPECT_NEAR(theta(-1e-9, 2), 0.25, 1e-9);
  EXPECT_NEAR(theta(0, -2), -0.25, 1e-15);  // the cut lies there: −¼ from the right, ¾ from the left
}

TEST(MoreWildSet, Objective_AtMinimiser_IsTheLeast) {
  for (const TestProblem& problem : Problems("more_wild")) {
    if (problem.best_x.empty()) continue;
    EXPECT_NEAR(problem.make()->Objective(problem.best_x), problem.best_objective.value(), problem.resolution)
        << problem.name;
  }
}

// Rows whose start leads both solvers below to another minimum, and that.
const std::map<std::string, double>& OtherMinima() {
  static const std::map<std::string, double> least_squares = {
      {"mw13_freudenstein_roth_2", 48.9842},  // Moré, Garbow and Hillstrom (1981)
      {"mw14_freudenstein_roth_2_x10", 48.9842},
      {"mw38_osborne_2_11_x10", 1.78981},
  };
  return least_squares;
}

double Lowest(const FitProblem& fit, const std::vector<std::string>& solvers) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::string& solver : solvers) {
    lowest = std::min(lowest, SolveWith(solver, fit, TightestTolerances()).objective);
  }
  return lowest;
}

// Brown and Dennis's function and BDQRTIC have large residuals, where Gauss's approximation of the Hessian
// leads LM on for thousands of steps, and Bard's from the far start has an infimum at infinity where LM goes;
// lbfgs has the gradient alone.
TEST(MoreWildSet, Descent_FromStarts_ReachesTheLeastAndNothingLess) {
  for (const TestProblem& problem : Problems("more_wild")) {
    SCOPED_TRACE(problem.name);
    if (!problem.best_objective.has_value()) continue;
    const double least = *problem.best_objective;
    const double lowest = Lowest(*problem.make(), {"lm", "lbfgs"});
    EXPECT_GE(lowest, least - problem.resolution);
    const auto other = OtherMinima().find(problem.name);
    if (other == OtherMinima().end()) {
      EXPECT_LE(lowest, least * (1 + 1e-10) + problem.resolution);
    } else {
      EXPECT_NEAR(2 * lowest, other->second, 1e-5 * other->second);
    }
  }
}

TEST(MoreWildSet, Resolution_CoversRoundingWhereLmEnds) {
  const std::vector<TestProblem> problems = Problems("more_wild");
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const MoreWildRow& row = MoreWildRows()[i];
    const SolverReport report = SolveWith("lm", *problems[i].make(), TightestTolerances());
    const std::vector<long double> x(report.x.begin(), report.x.end());
    std::vector<long double> residuals(static_cast<std::size_t>(row.m));
    MoreWildResiduals(row.function, row.n, row.m, x.data(), residuals.data());
    long double exact = 0;
    for (const long double residual : residuals) exact += residual * residual / 2;
    // The share is for rows that end far from the least.
    EXPECT_NEAR(report.objective, static_cast<double>(exact),
                problems[i].resolution + 1e-12 * report.objective)
        << problems[i].name;
  }
}

}  // namespace
}  // namespace frond
