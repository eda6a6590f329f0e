// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/standard/fit_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frond {
namespace {

Options WithValues(const std::vector<OptionSpec>& specs, const OptionList& values) {
  Options options(specs);
  for (const auto& [name, value] : values) options.Set(name, value);
  return options;
}

}  // namespace

double CeresCost(const FitProblem& fit, std::span<const double> x) { return fit.FitProblem::Objective(x); }

std::vector<double> CeresGradient(const FitProblem& fit, std::span<const double> x) {
  LeastSquares least_squares(fit, 1);
  least_squares.SetX(x);
  std::vector<double> gradient;
  EXPECT_TRUE(least_squares.problem().Evaluate({}, nullptr, nullptr, &gradient, nullptr));
  return gradient;
}

void ExpectObjectiveIsCeresCost(const FitProblem& fit, std::span<const double> x, double share,
                                double absolute) {
  const double cost = CeresCost(fit, x);
  EXPECT_NEAR(fit.Objective(x), cost, share * std::abs(cost) + absolute);
}

void ExpectGradientMatchesDifferences(const FitProblem& fit, std::span<const double> x) {
  const std::vector<double> gradient = CeresGradient(fit, x);
  const double value = fit.Objective(x);
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double size = x[j] == 0 ? 1 : std::abs(x[j]), step = 1e-6 * size;
    std::vector<double> ahead(x.begin(), x.end()), behind = ahead;
    ahead[j] += step;
    behind[j] -= step;
    const double slope = (fit.Objective(ahead) - fit.Objective(behind)) / (ahead[j] - behind[j]);
    // Rounding of the value over the step, and a third derivative of up to 10⁶ value/size³.
    EXPECT_NEAR(gradient[j], slope, 1e-6 * (std::abs(slope) + value / size)) << "parameter " << j;
  }
}

std::vector<TestProblem> Problems(const std::string& set, const OptionList& options) {
  const ProblemSetType& type = FindProblemSetType(StandardSetTypes(), set);
  return type.problems(WithValues(type.options, options));
}

OptionList TightestTolerances() {
  return {{"function_tolerance", 0.0}, {"gradient_tolerance", 0.0}, {"parameter_tolerance", 0.0}};
}

SolverReport SolveWith(const std::string& solver, const FitProblem& fit, const OptionList& options) {
  const SolverType& type = FindSolverType(solver);
  return type.create(WithValues(type.options, options))->Solve(fit, {}, {});
}

}  // namespace frond
