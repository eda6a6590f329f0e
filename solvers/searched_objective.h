// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.h"
#include "solvers/budget_watch.h"
#include "solvers/search_box.h"

namespace frond {

// What other libraries are given for +∞, of which their models and selections make NaN.
constexpr double kWorstObjective = 1e150;

// A fit's objective as derivative-free solvers see it: over the searched values of a box, NaN as +∞, counted,
// with the best point, the trace and the budget kept in a report.
class SearchedObjective {
 public:
  // All must outlive this.
  SearchedObjective(const FitProblem& fit, const SearchBox& box, const Budget& budget, int threads,
                    SolverReport* report);

  // Evaluates objectives.size() points, box.size() values each, one after the other in `points`, on all
  // threads. Points that the evaluation budget has no room for are not evaluated, nor are those that would
  // begin after its time (the first one of all apart): they get NaN. The target does not cut a batch short,
  // so that counts do not depend on the threads.
  void Evaluate(std::span<const double> points, std::span<double> objectives);

  // Where all parameters are constant: one look at the start, and true with the report complete.
  bool FinishedWithoutSearch();

  // The cause, where no other batch may begin.
  std::optional<Termination> Cause() const { return watch_.Cause(report_->evaluations); }

  double best_objective() const { return watch_.best_objective(); }
  const Budget& budget() const { return watch_.budget(); }
  const SearchBox& box() const { return box_; }

  // Completes the report; without any finite objective the cause is kFailed, and x the fit's start.
  void Finish(Termination cause, std::string message, int iterations);

 private:
  const FitProblem& fit_;
  const SearchBox& box_;
  BudgetWatch watch_;
  WorkerTeam team_;
  SolverReport* report_;
};

}  // namespace frond
