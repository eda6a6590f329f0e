// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/solve_sequence.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frond {
namespace {

// The evaluation of `part` that found its objective.
std::int64_t FoundAt(const SolverReport& part) {
  const auto point = std::find_if(part.trace.begin(), part.trace.end(),
                                  [&](const TracePoint& at) { return at.best_objective <= part.objective; });
  return point == part.trace.end() ? part.evaluations : point->evaluations;
}

}  // namespace

Budget SolveSequence::Begin() {
  began_ = stopwatch_.Seconds();
  Budget rest = budget_;
  if (rest.LimitsEvaluations()) rest.max_evaluations -= report_.evaluations;
  rest.max_seconds -= began_;
  return rest;
}

std::optional<Termination> SolveSequence::Cause() const {
  if (report_.objective <= budget_.target_objective) return Termination::kTarget;
  if (report_.evaluations >= budget_.max_evaluations) return Termination::kEvaluationBudget;
  if (stopwatch_.Seconds() >= budget_.max_seconds) return Termination::kTimeBudget;
  if (any_ && report_.evaluations - improved_at_ >= budget_.stall_evaluations) return Termination::kStalled;
  return std::nullopt;
}

void SolveSequence::Add(const SolverReport& part, double objective) {
  for (const TracePoint& point : part.trace) {
    double best = point.best_objective;
    if (!report_.trace.empty()) best = std::fmin(best, report_.trace.back().best_objective);
    report_.trace.push_back({report_.evaluations + point.evaluations, began_ + point.seconds, best});
  }
  const std::int64_t evaluations_before = report_.evaluations;
  report_.evaluations += part.evaluations;
  report_.residual_evaluations += part.residual_evaluations;
  report_.jacobian_evaluations += part.jacobian_evaluations;
  report_.iterations += part.iterations;
  if (!any_ || objective < report_.objective || (std::isnan(report_.objective) && !std::isnan(objective))) {
    report_.x = part.x;
    report_.objective = objective;
    improved_at_ = evaluations_before + FoundAt(part);
  }
  any_ = true;
}

SolverReport SolveSequence::Finish(Termination termination, std::string message) {
  report_.termination = std::isfinite(report_.objective) ? termination : Termination::kFailed;
  report_.message = std::move(message);
  report_.seconds = stopwatch_.Seconds();
  return std::move(report_);
}

}  // namespace frond
