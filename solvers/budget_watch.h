// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "solvers/solver.h"
#include "solvers/stopwatch.h"

namespace frond {

// Knows when a solve has to stop: the one rule for all solvers.
class BudgetWatch {
 public:
  explicit BudgetWatch(const Budget& budget) : budget_(budget) {}

  // Takes an objective that the `evaluations`-th evaluation gave. True where it is better than all before.
  bool Learn(std::int64_t evaluations, double objective);

  // Why no other evaluation may begin after `evaluations`, if so.
  std::optional<Termination> Cause(std::int64_t evaluations) const;

  bool TimeIsUp() const { return stopwatch_.Seconds() >= budget_.max_seconds; }
  double Seconds() const { return stopwatch_.Seconds(); }
  double best_objective() const { return best_objective_; }
  const Budget& budget() const { return budget_; }

 private:
  Budget budget_;
  Stopwatch stopwatch_;
  double best_objective_ = std::numeric_limits<double>::infinity();
  std::int64_t best_evaluations_ = 0;
};

// "target reached", "evaluation budget used up", …
std::string StopMessage(Termination cause);

}  // namespace frond
