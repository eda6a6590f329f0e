// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/standard_experiment.h"

#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "problems/standard/problem_set.h"
#include "solvers/option_prefix.h"

namespace frond {
namespace {

// `set`, and each set's own options below its name: nist.problem, nist.start, …
std::vector<OptionSpec> Specs() {
  OptionSpec set{
      .name = "set",
      .type = OptionType::kChoice,
      .default_value = std::string("nist"),
      .help = "The set; its options stand in a section of its name and have to choose one problem"};
  std::vector<OptionSpec> specs;
  for (const ProblemSetType& type : StandardSetTypes()) {
    set.words.push_back(type.name);
    for (OptionSpec& spec : WithPrefix(type.name, type.options)) specs.push_back(std::move(spec));
  }
  specs.insert(specs.begin(), set);
  return specs;
}

TestProblem ChosenProblem(const Options& options) {
  const ProblemSetType& set = FindProblemSetType(StandardSetTypes(), options.Text("set"));
  std::vector<TestProblem> problems = set.problems(WithoutPrefix(set.name, set.options, options));
  if (problems.size() != 1) {
    throw ConfigError("set '" + set.name + "' holds " + std::to_string(problems.size()) +
                      " problems: choose one by the options of '" + set.name + "' (frond list " + set.name +
                      "), or run all with frond study");
  }
  return std::move(problems.front());
}

FitOutcome Run(const RunInput& /*input*/, const Options& options, const Solver& solver, const Budget& budget,
               const SolveContext& context) {
  const TestProblem problem = ChosenProblem(options);
  const std::shared_ptr<const FitProblem> fit = problem.make();
  FitOutcome outcome;
  StageClock clock;
  outcome.report = solver.Solve(*fit, budget, context);
  clock.End("solve");
  outcome.stages = clock.stages();
  if (outcome.report->termination == Termination::kFailed) {
    throw FitError(problem.name + ": " + outcome.report->message);
  }
  outcome.metrics.Set("name", problem.name);
  outcome.metrics.Set("objective", outcome.report->objective);
  if (problem.best_objective) outcome.metrics.Set("least_objective", *problem.best_objective);
  for (const auto& [name, value] : fit->Metrics(outcome.report->x)) outcome.metrics.Set(name, value);
  outcome.metrics.Set("x", outcome.report->x);
  return outcome;
}

}  // namespace

FitType StandardFitType() {
  return {.name = "standard",
          .help = "A problem of a standard set (NIST StRD, More and Wild, test functions); takes no input",
          .options = Specs(),
          .solver_defaults = [](const Options&, const std::string&) { return OptionDefaults(); },
          .check = [](const Options& options) { (void)ChosenProblem(options); },
          .run = Run,
          .formats = {},
          .input = InputKind::kNone};
}

}  // namespace frond
