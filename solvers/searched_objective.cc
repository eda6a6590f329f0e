// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/searched_objective.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frond {
namespace {

constexpr double kNotEvaluated = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SearchedObjective::SearchedObjective(const FitProblem& fit, const SearchBox& box, const Budget& budget,
                                     int threads, SolverReport* report)
    : fit_(fit), box_(box), watch_(budget), team_(threads), report_(report) {
  report_->x = box.x;
}

void SearchedObjective::Evaluate(std::span<const double> points, std::span<double> objectives) {
  const std::int64_t left = watch_.budget().max_evaluations - report_->evaluations;
  const auto count = static_cast<std::size_t>(
      std::clamp<std::int64_t>(left, 0, static_cast<std::int64_t>(objectives.size())));
  std::fill(objectives.begin(), objectives.end(), kNotEvaluated);
  const bool first_ever = report_->evaluations == 0;
  team_.For(count, 1, [&](std::size_t i, std::size_t) {
    if (!(first_ever && i == 0) && watch_.TimeIsUp()) return;
    const double objective = fit_.Objective(box_.FullVector(points.data() + i * box_.size()));
    objectives[i] = std::isnan(objective) ? std::numeric_limits<double>::infinity() : objective;
  });
  const double seconds = watch_.Seconds();
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(objectives[i])) continue;
    ++report_->evaluations;
    if (!watch_.Learn(report_->evaluations, objectives[i])) continue;
    report_->x = box_.FullVector(points.data() + i * box_.size());
    report_->trace.push_back({report_->evaluations, seconds, objectives[i]});
  }
}

bool SearchedObjective::FinishedWithoutSearch() {
  if (box_.size() > 0) return false;
  double objective = 0;
  Evaluate({}, {&objective, 1});
  Finish(Termination::kIterationLimit, "no free parameters", 0);
  return true;
}

void SearchedObjective::Finish(Termination cause, std::string message, int iterations) {
  report_->termination = cause;
  report_->message = std::move(message);
  report_->iterations = iterations;
  report_->residual_evaluations = report_->evaluations;
  report_->seconds = watch_.Seconds();
  if (std::isfinite(watch_.best_objective())) {
    report_->objective = watch_.best_objective();
    return;
  }
  report_->termination = Termination::kFailed;
  report_->message =
      "no finite objective at any of the " + std::to_string(report_->evaluations) + " points evaluated";
  if (box_.size() > 0) report_->message += "; set 'start_box' to where the fit can be evaluated";
}

}  // namespace frond
