// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/nist_set.h"

#include "base/option_specs.h"
#include "problems/standard/lower_case.h"
#include "problems/standard/nist_data.h"
#include "problems/standard/nist_fit.h"
#include "problems/standard/problem_choice.h"

namespace frond {
namespace {

TestProblem MakeProblem(const NistDataset& dataset, const std::string& name, int start) {
  TestProblem problem{.name = name,
                      .make = [&dataset, start] { return std::make_shared<NistFit>(dataset, start); },
                      .best_objective = dataset.rss / 2,
                      .resolution = NistResolution(dataset)};
  for (const NistParameter& parameter : dataset.parameters) problem.best_x.push_back(parameter.certified);
  return problem;
}

std::vector<TestProblem> NistProblems(const Options& options) {
  std::vector<std::string> names;
  for (const NistDataset& dataset : NistDatasets()) names.push_back(LowerCase(dataset.name));
  const std::string& start = options.Text("start");
  std::vector<TestProblem> problems;
  for (const std::size_t i : ChosenProblems(options, names)) {
    const NistDataset& dataset = NistDatasets()[i];
    if (start == "box") problems.push_back(MakeProblem(dataset, names[i], 2));
    if (start == "both" || start == "1") problems.push_back(MakeProblem(dataset, names[i] + "_1", 1));
    if (start == "both" || start == "2") problems.push_back(MakeProblem(dataset, names[i] + "_2", 2));
  }
  return problems;
}

}  // namespace

ProblemSetType NistSetType() {
  return {.name = "nist",
          .help = "NIST StRD non-linear regression: 27 data sets, two published starts, certified results",
          .options = {ProblemChoiceSpec("all, or one data set by name: misra1a, mgh09, …"),
                      ChoiceSpec("start", {"both", "1", "2", "box"},
                                 "NIST's far start (1), near start (2) or both; box: each data set once, "
                                 "starts drawn around the two (where none is drawn: start 2)")},
          .problems = NistProblems};
}

}  // namespace frond
