// SPDX-License-Identifier: BSD-3-Clause
// `pso` as a solver: options, batches, budgets. The swarm itself is in particle_swarm.cc.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "base/parallel.h"
#include "solvers/particle_swarm.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/stopwatch.h"

namespace frond {
namespace {

using Settings = ParticleSwarmSettings;

// Evaluates batches of the swarm, keeps the report and knows when to stop.
class SwarmRun {
 public:
  SwarmRun(const FitProblem& fit, const Budget& budget, int threads, const SearchBox& box,
           ParticleSwarm* swarm, SolverReport* report)
      : fit_(fit), budget_(budget), threads_(threads), box_(box), swarm_(swarm), report_(report) {}

  void EvaluateBatch() {
    const std::int64_t left = budget_.max_evaluations - report_->evaluations;
    const int count = static_cast<int>(std::clamp<std::int64_t>(left, 0, swarm_->size()));
    std::vector<double> objectives(count);
    std::vector<char> evaluated(count, 0);
    ParallelFor(count, 1, threads_, [&](std::size_t i, std::size_t) {
      if (i > 0 && TimeIsUp()) return;
      const double objective = fit_.Objective(box_.FullVector(swarm_->Position(static_cast<int>(i))));
      objectives[i] = std::isnan(objective) ? std::numeric_limits<double>::infinity() : objective;
      evaluated[i] = 1;
    });
    const double seconds = stopwatch_.Seconds();
    bool improved = false;
    for (int i = 0; i < count; ++i) {
      if (evaluated[i] == 0) continue;
      ++report_->evaluations;
      if (!swarm_->Learn(i, objectives[i])) continue;
      improved = true;
      report_->trace.push_back({report_->evaluations, seconds, objectives[i]});
    }
    stalled_ = improved ? 0 : stalled_ + 1;
  }

  // True, with the cause in the report, where no other batch may follow.
  bool Finished(int iteration, int max_iterations, int stall_iterations) {
    report_->iterations = iteration;
    const auto stop = [&](Termination cause, const std::string& message) {
      report_->termination = cause;
      report_->message = message;
      return true;
    };
    if (!std::isfinite(swarm_->best_objective())) {
      return stop(Termination::kFailed, "no finite objective at any of the " +
                                            std::to_string(report_->evaluations) + " starting positions");
    }
    if (swarm_->best_objective() <= budget_.target_objective)
      return stop(Termination::kTarget, "target reached");
    if (report_->evaluations >= budget_.max_evaluations) {
      return stop(Termination::kEvaluationBudget, "evaluation budget used up");
    }
    if (TimeIsUp()) return stop(Termination::kTimeBudget, "time budget used up");
    if (stall_iterations > 0 && stalled_ >= stall_iterations) {
      return stop(Termination::kStalled, "no better best in " + std::to_string(stalled_) + " iterations");
    }
    if (iteration >= max_iterations) return stop(Termination::kIterationLimit, "iteration limit reached");
    return false;
  }

  double Seconds() const { return stopwatch_.Seconds(); }

 private:
  bool TimeIsUp() const { return stopwatch_.Seconds() >= budget_.max_seconds; }

  const FitProblem& fit_;
  const Budget& budget_;
  int threads_;
  const SearchBox& box_;
  ParticleSwarm* swarm_;
  SolverReport* report_;
  Stopwatch stopwatch_;
  int stalled_ = 0;
};

// The last iteration that the settings and the budget allow: eq. (14) runs its course up to there.
int LastIteration(const Settings& settings, const Budget& budget) {
  const std::int64_t batches = std::max<std::int64_t>(budget.max_evaluations - 1, 0) / settings.swarm_size;
  return static_cast<int>(std::min<std::int64_t>(settings.iterations, batches));
}

class ParticleSwarmSolver final : public Solver {
 public:
  ParticleSwarmSolver(const Settings& settings, OptionValue start_box)
      : settings_(settings), start_box_(std::move(start_box)) {}

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    const QuietCeresLog quiet;
    const SearchBox box = MakeSearchBox(fit, start_box_, "pso");
    Settings settings = settings_;
    if (box.size() == 0) {  // all parameters are constant: one look at the start
      settings.swarm_size = 1;
      settings.iterations = 0;
    }
    Random random(context.seed);
    ParticleSwarm swarm(box, settings, &random);
    SolverReport report;
    SwarmRun run(fit, budget, context.threads, box, &swarm, &report);

    const int last = LastIteration(settings, budget);
    run.EvaluateBatch();
    for (int j = 1; !run.Finished(j - 1, settings.iterations, settings.stall_iterations); ++j) {
      swarm.Move(InertiaWeight(settings.inertia, j, last));
      run.EvaluateBatch();
    }
    report.x = report.termination == Termination::kFailed ? box.x : box.FullVector(swarm.best_position());
    if (report.termination != Termination::kFailed) report.objective = swarm.best_objective();
    report.residual_evaluations = report.evaluations;
    report.seconds = run.Seconds();
    return report;
  }

 private:
  Settings settings_;
  OptionValue start_box_;
};

}  // namespace

std::vector<OptionSpec> ParticleSwarmSpecs() {
  const Settings defaults;
  return {
      IntegerSpec("swarm_size", defaults.swarm_size, 1, 1e9, "Particles (the leaf paper: 5)"),
      IntegerSpec("iterations", defaults.iterations, 0, 1e9, "Moves of the swarm (the leaf paper: 10)"),
      ChoiceSpec(
          "inertia", {"constriction", "linear"},
          "constriction: 0.7298 throughout; linear: 0.9 to 0.4 over the iterations, as in the leaf paper "
          "(with cognitive: 2, social: 2)"),
      NumberSpec("cognitive", defaults.cognitive, 0, 4, "Pull towards the particle's own best (c1)"),
      NumberSpec("social", defaults.social, 0, 4, "Pull towards its informants' best (c2)"),
      NumberSpec("velocity_limit", defaults.velocity_limit, 1e-9, 1e9,
                 "Longest step in each dimension, as a share of the start box"),
      ChoiceSpec("boundary", {"reflect", "clamp", "absorb"},
                 "At a bound: mirrored; put on it with its velocity kept; put on it at rest"),
      ChoiceSpec("topology", {"gbest", "ring"}, "Who informs whom: everyone, or two neighbours"),
      StartBoxSpec(),
      {.name = "start_at_guess",
       .type = OptionType::kFlag,
       .default_value = defaults.start_at_guess,
       .help = "Put the first particle at the fit's start"},
      IntegerSpec("stall_iterations", defaults.stall_iterations, 0, 1e9,
                  "Stop after so many iterations without a better best; 0: never"),
  };
}

ParticleSwarmSettings ParticleSwarmSettingsFrom(const Options& options) {
  Settings settings;
  settings.swarm_size = options.Integer("swarm_size");
  settings.iterations = options.Integer("iterations");
  settings.inertia =
      options.Text("inertia") == "linear" ? Settings::Inertia::kLinear : Settings::Inertia::kConstriction;
  settings.cognitive = options.Number("cognitive");
  settings.social = options.Number("social");
  settings.velocity_limit = options.Number("velocity_limit");
  const std::string& boundary = options.Text("boundary");
  settings.boundary = boundary == "clamp"    ? Settings::Boundary::kClamp
                      : boundary == "absorb" ? Settings::Boundary::kAbsorb
                                             : Settings::Boundary::kReflect;
  settings.topology = options.Text("topology") == "ring" ? SwarmTopology::kRing : SwarmTopology::kGlobal;
  settings.start_at_guess = options.Flag("start_at_guess");
  settings.stall_iterations = options.Integer("stall_iterations");
  return settings;
}

SolverType ParticleSwarmSolverType() {
  return {"pso", "Particle swarm (Kennedy and Eberhart), minimises the fit's objective without derivatives",
          ParticleSwarmSpecs(), [](const Options& options) -> std::unique_ptr<Solver> {
            return std::make_unique<ParticleSwarmSolver>(ParticleSwarmSettingsFrom(options),
                                                         options.Value("start_box"));
          }};
}

}  // namespace frond
