// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/hybrid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solvers/ceres_solvers.h"
#include "solvers/fit_from.h"
#include "solvers/option_prefix.h"
#include "solvers/particle_swarm.h"
#include "solvers/solve_sequence.h"

namespace frond {
namespace {

// Where the evaluations or the seconds are limited, so are the swarm's; else its own iteration limit ends it.
Budget Share(const Budget& budget, double share) {
  Budget part = budget;
  if (budget.LimitsEvaluations()) {
    const double evaluations = share * static_cast<double>(budget.max_evaluations);
    part.max_evaluations = std::max<std::int64_t>(1, std::llround(evaluations));
  }
  part.max_seconds = share * budget.max_seconds;
  return part;
}

// What ended the solve: the whole budget has the first word, for the descent had a part of it.
Termination End(std::optional<Termination> cause, Termination descent) {
  if (cause && *cause != Termination::kStalled) return *cause;
  const bool by_itself = descent == Termination::kConverged || descent == Termination::kStalled;
  return by_itself ? descent : Termination::kIterationLimit;
}

class PsoLmSolver final : public Solver {
 public:
  PsoLmSolver(std::unique_ptr<Solver> pso, std::unique_ptr<Solver> lm, double pso_share)
      : pso_(std::move(pso)), lm_(std::move(lm)), pso_share_(pso_share) {}

  void Check(const FitProblem& fit) const override {
    pso_->Check(fit);
    lm_->Check(fit);
  }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    Check(fit);
    SolveSequence sequence(budget);
    const SolverReport swarm = pso_->Solve(fit, Share(sequence.Begin(), pso_share_), context);
    sequence.Add(swarm, swarm.objective);
    if (swarm.termination == Termination::kFailed || sequence.Cause()) {
      return sequence.Finish(sequence.Cause().value_or(swarm.termination), "pso: " + swarm.message);
    }
    // A fit that tracks feet may report a cost that a fresh look at x corrects: compare by the same function,
    // for which an evaluation is kept back (where the descent met the target there is nothing to compare).
    Budget rest = sequence.Begin();
    if (rest.LimitsEvaluations()) rest.max_evaluations = std::max<std::int64_t>(1, rest.max_evaluations - 1);
    const SolverReport descent = lm_->Solve(FitFrom(fit, swarm.x), rest, context);
    if (descent.termination == Termination::kTarget) {
      sequence.Add(descent, descent.objective);
    } else {
      sequence.Add(descent, fit.Objective(descent.x));
      sequence.CountEvaluation();
    }
    return sequence.Finish(End(sequence.Cause(), descent.termination),
                           "pso: " + swarm.message + "; lm: " + descent.message);
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
