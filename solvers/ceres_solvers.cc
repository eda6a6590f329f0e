// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/ceres_solvers.h"

#include <ceres/iteration_callback.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/errors.h"
#include "solvers/active_bounds.h"
#include "solvers/budget_watch.h"
#include "solvers/ceres_options.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/refinement.h"

namespace frond {
namespace {

// Follows a solve: keeps its trace, and stops it on the target or a used-up budget.
class Monitor final : public ceres::IterationCallback {
 public:
  // The clock runs from here on.
  Monitor(const FitProblem& fit, const Budget& budget, SolverReport* report)
      : fit_(fit), watch_(budget), report_(report) {}

  // Before all else: the problem to follow.
  void Follow(LeastSquares* least_squares) { least_squares_ = least_squares; }

  // Runs after each iteration, the zeroth included; the user state then holds the best iterate so far.
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    report_->iterations = iterations_before_ + summary.iteration;
    if (summary.iteration == 0 || summary.step_is_successful) Accept(summary.cost);
    AddToTrace();
    if (MayGoOn() &&
        best_cost_ ==
            0) {  // nothing is below; Ceres would try on, and fail in the end where tolerances are 0
      stopped_ = true;
      report_->termination = Termination::kConverged;
      report_->message = "the cost is zero";
    }
    return MayGoOn() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  // False, with the cause in the report, where the budget is used up.
  bool MayGoOn() {
    const std::int64_t evaluations = least_squares_->ChargedEvaluations();
    if (stopped_) return false;
    if (evaluations == 0) return true;
    if (const auto cause = watch_.Cause(evaluations)) {
      report_->termination = *cause;
      report_->message = StopMessage(*cause);
      stopped_ = true;
    }
    return !stopped_;
  }

  double best_cost() const { return best_cost_; }

  // Takes over x after a refinement, if that gave a cost: it may be a rounding above the best.
  void Refined(std::optional<double> cost) {
    if (!cost) return;
    report_->x.assign(least_squares_->x().begin(), least_squares_->x().end());
    report_->objective = *cost;
    watch_.Learn(least_squares_->ChargedEvaluations(), report_->objective);
    AddToTrace();
  }

  // After each ceres::Solve. Some end after a last accepted step without calling back.
  void Finish(const ceres::Solver::Summary& summary) {
    if (summary.IsSolutionUsable() && !report_->x.empty() && summary.final_cost < best_cost_) {
      Accept(summary.final_cost);
      AddToTrace();
    }
    iterations_before_ = report_->iterations;
    if (stopped_) return;
    report_->message = summary.message;
    if (summary.termination_type == ceres::FAILURE) {
      report_->termination = Termination::kFailed;
    } else {
      report_->termination = summary.termination_type == ceres::CONVERGENCE ? Termination::kConverged
                                                                            : Termination::kIterationLimit;
    }
  }

  double Seconds() const { return watch_.Seconds(); }

 private:
  void AddToTrace() {
    report_->trace.push_back(
        {least_squares_->ChargedEvaluations(), watch_.Seconds(), watch_.best_objective()});
  }

  // The trust region's uphill steps (nonmonotonic_steps) leave the best iterate in place.
  void Accept(double cost) {
    if (!report_->x.empty() && !(cost < best_cost_)) return;
    best_cost_ = cost;
    report_->x.assign(least_squares_->x().begin(), least_squares_->x().end());
    report_->objective = fit_.ObjectiveIsLeastSquares() ? cost : fit_.Objective(report_->x);
    watch_.Learn(least_squares_->ChargedEvaluations(), report_->objective);
  }

  const FitProblem& fit_;
  BudgetWatch watch_;
  LeastSquares* least_squares_ = nullptr;
  SolverReport* report_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  int iterations_before_ = 0;
  bool stopped_ = false;
};

const char* MethodName(CeresMethod method) {
  switch (method) {
    case CeresMethod::kLevenbergMarquardt:
      return "lm";
    case CeresMethod::kDogleg:
      return "dogleg";
    case CeresMethod::kBfgs:
      return "bfgs";
    case CeresMethod::kLbfgs:
      return "lbfgs";
  }
  return "lm";
}

// `what` cannot work on a fit with bounds, or (the solver's own way of dealing with them apart) manifolds.
void RefuseBounds(const FitProblem& fit, const std::string& what, bool manifolds_too) {
  const auto finite = [](double bound) { return std::isfinite(bound); };
  for (const ParameterBlock& block : fit.parameters()) {
    if (block.constant) continue;
    if (std::any_of(block.lower.begin(), block.lower.end(), finite) ||
        std::any_of(block.upper.begin(), block.upper.end(), finite)) {
      throw ConfigError(what + " cannot hold bounds, and parameter '" + block.name +
                        "' has some: " + (manifolds_too ? "leave it out" : "use lm, dogleg, pso or pso_lm"));
    }
    if (manifolds_too && block.manifold != nullptr) {
      throw ConfigError(what + " cannot move parameter '" + block.name + "', which lives on a manifold");
    }
  }
}

class CeresSolver final : public Solver {
 public:
  CeresSolver(CeresMethod method, Options options) : method_(method), options_(std::move(options)) {}

  void Check(const FitProblem& fit) const override {
    if (IsLineSearch(method_)) RefuseBounds(fit, std::string("solver '") + MethodName(method_) + "'", false);
    if (!Refines()) return;
    RefuseBounds(fit, "option 'refine'", true);
    if (!fit.ObjectiveIsLeastSquares()) {
      throw ConfigError("option 'refine' needs a fit whose objective is its sum of squares: leave it out");
    }
  }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    Check(fit);
    const QuietCeresLog quiet;
    SolverReport report;
    Monitor monitor(fit, budget, &report);  // first: building the fit's state takes time too
    LeastSquares least_squares(fit, context.threads);
    monitor.Follow(&least_squares);

    // One thread inside Ceres, so that results have the same bits for any context.threads (ceres_options.h).
    ceres::Solver::Options options = CeresOptionsFrom(options_, 1, method_);
    options.callbacks.push_back(&monitor);
    const int max_iterations = options.max_num_iterations;
    least_squares.SetGate([&monitor] { return monitor.MayGoOn(); });
    ActiveBounds bounds(fit, &least_squares);
    try {
      double cost_before = 0;
      do {
        cost_before = monitor.best_cost();
        options.max_num_iterations = max_iterations - report.iterations;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &least_squares.problem(), &summary);
        monitor.Finish(summary);
        if (report.x.empty()) ReportStart(fit, summary, monitor, &least_squares, &report);
      } while (report.termination == Termination::kConverged && monitor.best_cost() < cost_before &&
               bounds.Update() && monitor.MayGoOn());
      if (Refines() && report.termination == Termination::kConverged) {
        monitor.Refined(RefineByGaussNewton(monitor.best_cost(), &least_squares));
      }
    } catch (const EvaluationRefused&) {
      // The report holds the best iterate so far, and the monitor's cause.
    }
    report.evaluations = least_squares.ChargedEvaluations();
    report.residual_evaluations = least_squares.counts().residual_evaluations;
    report.jacobian_evaluations = least_squares.counts().jacobian_evaluations;
    report.seconds = monitor.Seconds();
    return report;
  }

 private:
  bool Refines() const { return !IsLineSearch(method_) && options_.Flag("refine"); }

  // Ceres gave up before its first iteration: the start cannot be evaluated, or all parameters are constant.
  static void ReportStart(const FitProblem& fit, const ceres::Solver::Summary& summary,
                          const Monitor& monitor, LeastSquares* least_squares, SolverReport* report) {
    report->x = fit.StartVector();
    if (summary.termination_type == ceres::FAILURE) return;
    least_squares->SetX(report->x);
    report->objective = fit.ObjectiveIsLeastSquares() ? least_squares->Cost() : fit.Objective(report->x);
    if (!std::isfinite(report->objective)) report->termination = Termination::kFailed;
    report->trace.push_back({least_squares->ChargedEvaluations(), monitor.Seconds(), report->objective});
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

SolverType BfgsSolverType() {
  return Type("bfgs", "BFGS with Wolfe line search (Ceres); dense, unbounded fits only", CeresMethod::kBfgs);
}

SolverType LbfgsSolverType() {
  return Type("lbfgs", "Limited-memory BFGS with Wolfe line search (Ceres); unbounded fits only",
              CeresMethod::kLbfgs);
}

}  // namespace frond
