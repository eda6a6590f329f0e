// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/options.h"
#include "solvers/fit_problem.h"

namespace frond {

// When a solve has to stop, whatever the solver. Evaluations are residual evaluations, a Jacobian of n
// parameters charged n of them (2n where numeric): the same unit for every solver. No evaluation (of a swarm:
// no batch) begins after the evaluations or the seconds are used up, the target is reached or progress has
// stalled.
struct Budget {
  std::int64_t max_evaluations = std::numeric_limits<std::int64_t>::max();
  double max_seconds = std::numeric_limits<double>::infinity();
  double target_objective = -std::numeric_limits<double>::infinity();
  // Evaluations spent without a better best. Solvers made of solves judge it between these as well as inside
  // each.
  std::int64_t stall_evaluations = std::numeric_limits<std::int64_t>::max();

  bool LimitsEvaluations() const { return max_evaluations != std::numeric_limits<std::int64_t>::max(); }

  // By evaluations or seconds: what ends every solve.
  bool IsLimited() const {
    return LimitsEvaluations() || max_seconds < std::numeric_limits<double>::infinity();
  }
};

enum class Termination {
  kConverged,  // the solver's own tolerance
  kTarget,     // target_objective reached
  kEvaluationBudget,
  kTimeBudget,
  kIterationLimit,
  kStalled,  // no better best in stall_evaluations
  kFailed,   // no usable result; `message` says why
};
const char* TerminationName(Termination termination);  // "converged", "evaluation_budget", …

struct TracePoint {
  std::int64_t evaluations = 0;
  double seconds = 0;
  double best_objective = 0;
};

struct SolverReport {
  std::vector<double> x;  // best found
  double objective = std::numeric_limits<double>::quiet_NaN();
  Termination termination = Termination::kFailed;
  std::string message;
  std::int64_t evaluations = 0;  // the budget's unit
  std::int64_t residual_evaluations = 0;
  std::int64_t jacobian_evaluations = 0;
  int iterations = 0;
  double seconds = 0;
  std::vector<TracePoint> trace;
};

struct SolveContext {
  int threads = 1;
  std::uint64_t seed = 0;
};

class Solver {
 public:
  virtual ~Solver() = default;

  // Throws ConfigError for a fit that this solver does not take, before any evaluation; FitError as
  // CheckParameters does. Solve does so first, and may find more to refuse (in the budget, in its library).
  virtual void Check(const FitProblem& /*fit*/) const {}

  virtual SolverReport Solve(const FitProblem& fit, const Budget& budget,
                             const SolveContext& context) const = 0;
};

// A registered solver: its name in configs, one line of help, its options, and how to build it from them.
struct SolverType {
  std::string name;
  std::string help;
  std::vector<OptionSpec> options;
  std::function<std::unique_ptr<Solver>(const Options&)> create;
};

// All solvers, sorted by name. A new one is one file and one line in solver_registry.cc.
const std::vector<SolverType>& SolverTypes();

// Throws ConfigError naming the unknown solver and the nearest known one.
const SolverType& FindSolverType(const std::string& name);

}  // namespace frond
