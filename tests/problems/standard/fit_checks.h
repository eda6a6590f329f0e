// SPDX-License-Identifier: BSD-3-Clause
// What holds of every fit that overrides Objective, and a solve by name.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "problems/standard/problem_set.h"
#include "solvers/fit_problem.h"
#include "solvers/solver.h"

namespace frond {

// The cost that Ceres evaluates from the residual blocks.
double CeresCost(const FitProblem& fit, std::span<const double> x);

// Its gradient by the fit's own derivatives.
std::vector<double> CeresGradient(const FitProblem& fit, std::span<const double> x);

// Objective against CeresCost, to `share` of it and `absolute`.
void ExpectObjectiveIsCeresCost(const FitProblem& fit, std::span<const double> x, double share = 1e-13,
                                double absolute = 1e-30);

// CeresGradient against central differences of Objective.
void ExpectGradientMatchesDifferences(const FitProblem& fit, std::span<const double> x);

using OptionList = std::vector<std::pair<std::string, OptionValue>>;

std::vector<TestProblem> Problems(const std::string& set, const OptionList& options = {});

// None, so that Ceres goes on until no step lowers the cost: at a change of cost of 1e-12 half of the digits
// are still missing in the parameters.
OptionList TightestTolerances();

SolverReport SolveWith(const std::string& solver, const FitProblem& fit, const OptionList& options = {});

}  // namespace frond
