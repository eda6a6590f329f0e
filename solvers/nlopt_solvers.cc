// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/nlopt_solvers.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/searched_objective.h"

namespace frond {
namespace {

struct NloptDeleter {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using NloptHandle = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, NloptDeleter>;

// What the C callback is given.
struct Callback {
  SearchedObjective* objective;
  nlopt_opt opt;
  std::exception_ptr error = nullptr;

  static double Evaluate(unsigned n, const double* x, double* /*gradient*/, void* data) {
    auto* self = static_cast<Callback*>(data);
    double value = kWorstObjective;
    try {
      if (self->error == nullptr) self->objective->Evaluate({x, n}, {&value, 1});
      if (self->objective->Cause()) nlopt_force_stop(self->opt);
    } catch (...) {
      self->error = std::current_exception();
      nlopt_force_stop(self->opt);
    }
    return value < kWorstObjective ? value : kWorstObjective;
  }
};

class NloptSolver final : public Solver {
 public:
  NloptSolver(std::string name, nlopt_algorithm algorithm, Options options)
      : name_(std::move(name)), algorithm_(algorithm), options_(std::move(options)) {}

  void Check(const FitProblem& fit) const override { CheckedBox(fit); }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    const QuietCeresLog quiet;
    const SearchBox box = CheckedBox(fit);
    SolverReport report;
    SearchedObjective objective(fit, box, budget, context.threads, &report);
    if (objective.FinishedWithoutSearch()) return report;
    const NloptHandle opt(nlopt_create(algorithm_, static_cast<unsigned>(box.size())));
    Callback callback{&objective, opt.get()};
    CheckTolerances(budget);
    Configure(box, &callback, opt.get());
    Random random(context.seed);
    std::vector<double> x = box.RandomPoint(&random);
    if (options_.Flag("start_at_guess")) x = box.StartPoint();
    double value = 0;
    if (algorithm_ == NLOPT_LN_BOBYQA) {  // it moves a start near a bound away from it without a look at it
      objective.Evaluate(x, {&value, 1});
      if (const auto cause = objective.Cause()) {
        objective.Finish(*cause, StopMessage(*cause), 0);
        return report;
      }
    }
    const nlopt_result result = nlopt_optimize(opt.get(), x.data(), &value);
    if (callback.error != nullptr) std::rethrow_exception(callback.error);
    Finish(result, &objective);
    return report;
  }

 private:
  SearchBox CheckedBox(const FitProblem& fit) const {
    SearchBox box = MakeSearchBox(fit, options_.Value("start_box"), name_);
    if (algorithm_ == NLOPT_LN_BOBYQA && box.size() == 1) {
      throw ConfigError("solver '" + name_ + "' needs two free parameters or more: use nlopt.nelder_mead");
    }
    Steps(box);
    return box;
  }

  // The first step of each searched value.
  std::vector<double> Steps(const SearchBox& box) const {
    std::vector<double> step(box.size());
    for (std::size_t d = 0; d < box.size(); ++d) {
      step[d] = options_.Number("initial_step") * (box.start_upper[d] - box.start_lower[d]);
      if (!(step[d] > 0)) throw ConfigError("solver '" + name_ + "' cannot search a start box without width");
      if (algorithm_ == NLOPT_LN_BOBYQA && 2 * step[d] > box.upper[d] - box.lower[d]) {
        throw ConfigError("option 'initial_step' of solver '" + name_ + "' is " +
                          FormatValue(options_.Value("initial_step")) +
                          ", longer than half of the bounds' width: set 0.5 or less");
      }
    }
    return step;
  }

  void CheckTolerances(const Budget& budget) const {
    const bool stalls = budget.stall_evaluations != std::numeric_limits<std::int64_t>::max();
    if (options_.Number("xtol") > 0 || options_.Number("ftol") > 0 || budget.IsLimited() || stalls) return;
    throw ConfigError(
        "solver '" + name_ +
        "' never stops with options 'xtol' and 'ftol' both 0 and no limit in the budget: set one");
  }

  void Configure(const SearchBox& box, Callback* callback, nlopt_opt opt) const {
    nlopt_set_min_objective(opt, Callback::Evaluate, callback);
    nlopt_set_lower_bounds(opt, box.lower.data());
    nlopt_set_upper_bounds(opt, box.upper.data());
    nlopt_set_initial_step(opt, Steps(box).data());
    nlopt_set_xtol_rel(opt, options_.Number("xtol"));
    nlopt_set_ftol_rel(opt, options_.Number("ftol"));
  }

  void Finish(nlopt_result result, SearchedObjective* objective) const {
    if (const auto cause = objective->Cause()) {
      objective->Finish(*cause, StopMessage(*cause), 0);
    } else if (result > 0 || result == NLOPT_ROUNDOFF_LIMITED) {
      objective->Finish(Termination::kConverged, nlopt_result_to_string(result), 0);
    } else {
      objective->Finish(Termination::kFailed, std::string("NLopt: ") + nlopt_result_to_string(result), 0);
    }
  }

  std::string name_;
  nlopt_algorithm algorithm_;
  Options options_;
};

SolverType Type(const std::string& name, const std::string& help, nlopt_algorithm algorithm) {
  return {
      name,
      help,
      {StartBoxSpec(),
       FlagSpec("start_at_guess", true, "Begin at the fit's start, else at a point drawn in the start box"),
       NumberSpec("initial_step", 0.25, 1e-12, 1, "First step, as a share of the start box"),
       NumberSpec("xtol", 1e-12, 0, 1, "Converged where the points' relative change is less"),
       NumberSpec("ftol", 0, 0, 1, "Converged where the objective's relative change is less; 0 never")},
      [name, algorithm](const Options& options) -> std::unique_ptr<Solver> {
        return std::make_unique<NloptSolver>(name, algorithm, options);
      }};
}

}  // namespace

std::vector<SolverType> NloptSolverTypes() {
  return {Type("nlopt.nelder_mead", "NLopt's Nelder-Mead simplex, with bounds", NLOPT_LN_NELDERMEAD),
          Type("nlopt.bobyqa", "NLopt's BOBYQA: quadratic models in a trust region, with bounds",
               NLOPT_LN_BOBYQA)};
}

}  // namespace frond
