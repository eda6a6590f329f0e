// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/hybrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solvers/ceres_solvers.h"
#include "solvers/fit_from.h"
#include "solvers/option_prefix.h"
#include "solvers/particle_swarm.h"

namespace frond {
namespace {

// Where the evaluations or the seconds are limited, so are the swarm's; else its own iteration limit ends it.
Budget Share(const Budget& budget, double share) {
  Budget part = budget;
  if (budget.max_evaluations != std::numeric_limits<std::int64_t>::max()) {
    const double evaluations = share * static_cast<double>(budget.max_evaluations);
    part.max_evaluations = std::max<std::int64_t>(1, std::llround(evaluations));
  }
  part.max_seconds = share * budget.max_seconds;
  return part;
}

Budget Rest(const Budget& budget, const SolverReport& used) {
  Budget rest = budget;
  if (budget.max_evaluations != std::numeric_limits<std::int64_t>::max()) {
    rest.max_evaluations -= used.evaluations;
  }
  rest.max_seconds -= used.seconds;
  return rest;
}

// `second` was run after `first`, from its x.
SolverReport Joined(const SolverReport& first, const SolverReport& second, double second_objective) {
  SolverReport report = first;
  if (second_objective <= first.objective) {
    report.x = second.x;
    report.objective = second_objective;
  }
  if (second.termination != Termination::kFailed) report.termination = second.termination;
  report.message = "pso: " + first.message + "; lm: " + second.message;
  report.evaluations += second.evaluations;
  report.residual_evaluations += second.residual_evaluations;
  report.jacobian_evaluations += second.jacobian_evaluations;
  report.iterations += second.iterations;
  report.seconds += second.seconds;
  for (const TracePoint& point : second.trace) {
    const double best = report.trace.empty()
                            ? point.best_objective
                            : std::fmin(report.trace.back().best_objective, point.best_objective);
    report.trace.push_back({first.evaluations + point.evaluations, first.seconds + point.seconds, best});
  }
  return report;
}

class PsoLmSolver final : public Solver {
 public:
  PsoLmSolver(std::unique_ptr<Solver> pso, std::unique_ptr<Solver> lm, double pso_share)
      : pso_(std::move(pso)), lm_(std::move(lm)), pso_share_(pso_share) {}

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    SolverReport swarm = pso_->Solve(fit, Share(budget, pso_share_), context);
    const Budget rest = Rest(budget, swarm);
    if (swarm.termination == Termination::kFailed || swarm.termination == Termination::kTarget ||
        rest.max_evaluations <= 0 || rest.max_seconds <= 0) {
      return swarm;
    }
    const SolverReport descent = lm_->Solve(FitFrom(fit, swarm.x), rest, context);
    // A fit that tracks feet may report a cost that a fresh look at x corrects: compare by the same function.
    return Joined(swarm, descent, fit.Objective(descent.x));
  }

 private:
  std::unique_ptr<Solver> pso_, lm_;
  double pso_share_;
};

}  // namespace

SolverType PsoLmSolverType() {
  std::vector<OptionSpec> specs = {
      {.name = "pso_share",
       .type = OptionType::kNumber,
       .default_value = 0.5,
       .help = "Share of a limited budget (evaluations, seconds) for the swarm; without "
               "limits pso.iterations ends it",
       .minimum = 0.01,
       .maximum = 1}};
  const SolverType pso = ParticleSwarmSolverType(), lm = LmSolverType();
  for (OptionSpec& spec : WithPrefix("pso", pso.options)) specs.push_back(std::move(spec));
  for (OptionSpec& spec : WithPrefix("lm", lm.options)) specs.push_back(std::move(spec));
  return {"pso_lm", "A particle swarm, then Levenberg-Marquardt from its best", std::move(specs),
          [pso, lm](const Options& options) -> std::unique_ptr<Solver> {
            return std::make_unique<PsoLmSolver>(pso.create(WithoutPrefix("pso", pso.options, options)),
                                                 lm.create(WithoutPrefix("lm", lm.options, options)),
                                                 options.Number("pso_share"));
          }};
}

}  // namespace frond
