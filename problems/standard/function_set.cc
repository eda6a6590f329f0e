// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/function_set.h"

#include "base/errors.h"
#include "base/option_specs.h"
#include "problems/standard/analytic_fit.h"

namespace frond {
namespace {

const std::vector<std::string>& FunctionWords() {
  static const std::vector<std::string> words = {"all",        "ackley",   "griewank", "rastrigin",
                                                 "rosenbrock", "schwefel", "sphere"};
  return words;
}

TestProblem MakeProblem(const std::string& function, int dimension, const AnalyticPlacement& placement) {
  std::string name = function + "_" + std::to_string(dimension);
  if (placement.shift) name += "_shifted";
  if (placement.rotate) name += "_rotated";
  if (placement.shift || placement.rotate) name += "_" + std::to_string(placement.instance);
  return {.name = name,
          .make = [=] { return std::make_shared<AnalyticFit>(function, dimension, placement); },
          .best_objective = 0.0,
          .resolution = 1e-12 * dimension,
          .best_x = AnalyticFit(function, dimension, placement).minimiser()};
}

std::vector<TestProblem> FunctionProblems(const Options& options) {
  const AnalyticPlacement placement{.shift = options.Flag("shift"),
                                    .rotate = options.Flag("rotate"),
                                    .instance = options.Integer("instance")};
  // The default may stand there: configs of runs, which say everything, have to be readable again.
  if (placement.instance != AnalyticPlacement{}.instance && !placement.shift && !placement.rotate) {
    throw ConfigError("instance is set but has no effect without shift or rotate");
  }
  const std::string& chosen = options.Text("function");
  std::vector<TestProblem> problems;
  for (const std::string& function : FunctionWords()) {
    if (function == "all" || (chosen != "all" && chosen != function)) continue;
    problems.push_back(MakeProblem(function, options.Integer("dimension"), placement));
  }
  return problems;
}

}  // namespace

ProblemSetType FunctionSetType() {
  return {.name = "functions",
          .help = "Functions of global optimisation with minimum 0, in their customary boxes",
          .options = {ChoiceSpec("function", FunctionWords(), "One of them, or all"),
                      IntegerSpec("dimension", 10, 2, 1000, "Parameters of each"),
                      FlagSpec("shift", false, "Move the minimiser to a random place in the box"),
                      FlagSpec("rotate", false, "Turn the axes at random about the minimiser"),
                      IntegerSpec("instance", 1, 0, 1e9, "Which random shift and rotation")},
          .problems = FunctionProblems};
}

}  // namespace frond
