// SPDX-License-Identifier: BSD-3-Clause
// Problems to compare solvers on: fits with a name, made on demand, whose least objective is known or not.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/options.h"
#include "solvers/fit_problem.h"

namespace frond {

struct TestProblem {
  std::string name;  // unique within its set, [a-z0-9_]: "misra1a_1", "rosenbrock_10"
  // Deterministic, and re-entrant; may take as long as its fit's preparation does.
  std::function<std::shared_ptr<const FitProblem>()> make;
  std::optional<double> best_objective = {};  // the least there is (published, or by construction)
  double resolution = 0;            // differences of the objective below this are rounding (absolute)
  std::vector<double> best_x = {};  // published minimiser, by parameter; empty where none is
};

// A registered set: the value of `type` in a study's `problems` and of `set` in a fit's, its options, and the
// problems that they choose, in a fixed order.
struct ProblemSetType {
  std::string name;
  std::string help;
  std::vector<OptionSpec> options;
  // Throws ConfigError for values that single options cannot tell.
  std::function<std::vector<TestProblem>(const Options&)> problems;
};

// The standard sets, sorted by name. A new one is one file and one line in problem_set_registry.cc; sets of
// frond's own fits stand in experiments/study/study_sets.cc.
const std::vector<ProblemSetType>& StandardSetTypes();

// Throws ConfigError naming the unknown set and the nearest known one.
const ProblemSetType& FindProblemSetType(std::span<const ProblemSetType> types, const std::string& name);

}  // namespace frond
