// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/budget_watch.h"

namespace frond {

bool BudgetWatch::Learn(std::int64_t evaluations, double objective) {
  if (!(objective < best_objective_)) return false;
  best_objective_ = objective;
  best_evaluations_ = evaluations;
  return true;
}

std::optional<Termination> BudgetWatch::Cause(std::int64_t evaluations) const {
  if (best_objective_ <= budget_.target_objective) return Termination::kTarget;
  if (evaluations >= budget_.max_evaluations) return Termination::kEvaluationBudget;
  if (TimeIsUp()) return Termination::kTimeBudget;
  if (evaluations - best_evaluations_ >= budget_.stall_evaluations) return Termination::kStalled;
  return std::nullopt;
}

std::string StopMessage(Termination cause) {
  switch (cause) {
    case Termination::kTarget:
      return "target reached";
    case Termination::kEvaluationBudget:
      return "evaluation budget used up";
    case Termination::kTimeBudget:
      return "time budget used up";
    case Termination::kStalled:
      return "stalled: no better best within the evaluations allowed for that";
    case Termination::kIterationLimit:
      return "iteration limit reached";
    case Termination::kConverged:
      return "converged by the solver's own tolerances";
    case Termination::kFailed:
      return "failed";
  }
  return "failed";
}

}  // namespace frond
