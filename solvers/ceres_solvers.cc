// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/ceres_solvers.h"

#include <ceres/iteration_callback.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/errors.h"
#include "solvers/active_bounds.h"
#include "solvers/ceres_options.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/stopwatch.h"

namespace frond {
namespace {

// Follows a solve: keeps its trace, and stops it on the target or a used-up budget.
class Monitor final : public ceres::IterationCallback {
 public:
  Monitor(const FitProblem& fit, const Budget& budget, LeastSquares* least_squares, SolverReport* report)
      : fit_(fit), budget_(budget), least_squares_(least_squares), report_(report) {}

  // Runs after each iteration, the zeroth included; the user state then holds the best iterate so far.
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    report_->iterations = iterations_before_ + summary.iteration;
    if (summary.iteration == 0 || summary.step_is_successful) Accept(summary.cost);
    report_->trace.push_back({least_squares_->ChargedEvaluations(), stopwatch_.Seconds(), best_objective_});
    if (report_->objective <= budget_.target_objective) return Stop(Termination::kTarget);
    return MayGoOn() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  // False, with the cause in the report, where the budget is used up.
  bool MayGoOn() {
    if (least_squares_->ChargedEvaluations() >= budget_.max_evaluations) Stop(Termination::kEvaluationBudget);
    if (!stopped_ && stopwatch_.Seconds() >= budget_.max_seconds) Stop(Termination::kTimeBudget);
    return !stopped_;
  }

  double best_cost() const { return best_cost_; }

  // After each ceres::Solve. Some end after a last accepted step without calling back.
  void Finish(const ceres::Solver::Summary& summary) {
    if (summary.IsSolutionUsable() && !report_->x.empty() && summary.final_cost < best_cost_) {
      Accept(summary.final_cost);
      report_->trace.push_back({least_squares_->ChargedEvaluations(), stopwatch_.Seconds(), best_objective_});
    }
    iterations_before_ = report_->iterations;
    if (summary.termination_type == ceres::FAILURE) {
      report_->termination = Termination::kFailed;
    } else if (!stopped_) {
      report_->termination = summary.termination_type == ceres::CONVERGENCE ? Termination::kConverged
                                                                            : Termination::kIterationLimit;
    }
  }

  double Seconds() const { return stopwatch_.Seconds(); }

 private:
  // The trust region's uphill steps (nonmonotonic_steps) leave the best iterate in place.
  void Accept(double cost) {
    if (!report_->x.empty() && !(cost < best_cost_)) return;
    best_cost_ = cost;
    report_->x.assign(least_squares_->x().begin(), least_squares_->x().end());
    report_->objective = fit_.ObjectiveIsLeastSquares() ? cost : fit_.Objective(report_->x);
    best_objective_ = std::fmin(best_objective_, report_->objective);
  }

  ceres::CallbackReturnType Stop(Termination cause) {
    report_->termination = cause;
    stopped_ = true;
    return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  const FitProblem& fit_;
  const Budget& budget_;
  LeastSquares* least_squares_;
  SolverReport* report_;
  Stopwatch stopwatch_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  double best_objective_ = std::numeric_limits<double>::infinity();
  int iterations_before_ = 0;
  bool stopped_ = false;
};

void RefuseBounds(const FitProblem& fit) {
  const auto finite = [](double bound) { return std::isfinite(bound); };
  for (const ParameterBlock& block : fit.parameters()) {
    if (!block.constant && (std::any_of(block.lower.begin(), block.lower.end(), finite) ||
                            std::any_of(block.upper.begin(), block.upper.end(), finite))) {
      throw ConfigError("solver 'lbfgs' cannot hold bounds, and parameter '" + block.name +
                        "' has some: use lm, dogleg, pso or pso_lm");
    }
  }
}

class CeresSolver final : public Solver {
 public:
  CeresSolver(CeresMethod method, Options options) : method_(method), options_(std::move(options)) {}

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    if (method_ == CeresMethod::kLbfgs) RefuseBounds(fit);
    const QuietCeresLog quiet;
    LeastSquares least_squares(fit, context.threads);
    SolverReport report;
    Monitor monitor(fit, budget, &least_squares, &report);

    // One thread inside Ceres, so that results have the same bits for any context.threads (ceres_options.h).
    ceres::Solver::Options options = CeresOptionsFrom(options_, 1, method_);
    options.callbacks.push_back(&monitor);
    const int max_iterations = options.max_num_iterations;
    ActiveBounds bounds(fit, &least_squares);
    ceres::Solver::Summary summary;
    double cost_before = 0;
    do {
      cost_before = monitor.best_cost();
      options.max_num_iterations = max_iterations - report.iterations;
      ceres::Solve(options, &least_squares.problem(), &summary);
      monitor.Finish(summary);
    } while (report.termination == Termination::kConverged && monitor.best_cost() < cost_before &&
             bounds.Update() && monitor.MayGoOn());

    if (report.x.empty()) ReportStart(fit, summary, &least_squares, &report);
    report.message = summary.message;
    report.evaluations = least_squares.ChargedEvaluations();
    report.residual_evaluations = least_squares.counts().residual_evaluations;
    report.jacobian_evaluations = least_squares.counts().jacobian_evaluations;
    report.seconds = monitor.Seconds();
    return report;
  }

 private:
  // Ceres gave up before its first iteration: the start cannot be evaluated, or all parameters are constant.
  static void ReportStart(const FitProblem& fit, const ceres::Solver::Summary& summary,
                          LeastSquares* least_squares, SolverReport* report) {
    report->x = fit.StartVector();
    if (summary.termination_type == ceres::FAILURE) return;
    least_squares->SetX(report->x);
    report->objective = fit.ObjectiveIsLeastSquares() ? least_squares->Cost() : fit.Objective(report->x);
    if (!std::isfinite(report->objective)) report->termination = Termination::kFailed;
    report->trace.push_back({least_squares->ChargedEvaluations(), 0, report->objective});
  }

  CeresMethod method_;
  Options options_;
};

SolverType Type(const std::string& name, const std::string& help, CeresMethod method) {
  return {name, help, CeresOptionSpecs(method), [method](const Options& options) -> std::unique_ptr<Solver> {
            return std::make_unique<CeresSolver>(method, options);
          }};
}

}  // namespace

SolverType LmSolverType() {
  return Type("lm", "Levenberg-Marquardt (Ceres): the default for least squares",
              CeresMethod::kLevenbergMarquardt);
}

SolverType DoglegSolverType() {
  return Type("dogleg", "Powell's dogleg trust region (Ceres)", CeresMethod::kDogleg);
}

SolverType LbfgsSolverType() {
  return Type("lbfgs", "Limited-memory BFGS with Wolfe line search (Ceres); unbounded fits only",
              CeresMethod::kLbfgs);
}

}  // namespace frond
