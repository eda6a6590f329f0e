// SPDX-License-Identifier: BSD-3-Clause
// `pso` as a solver: options, batches, budgets. The swarm itself is in particle_swarm.cc.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "base/refuse_set.h"
#include "solvers/particle_swarm.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/searched_objective.h"

namespace frond {
namespace {

using Settings = ParticleSwarmSettings;

constexpr int kUnlimitedIterations = 1'000'000'000;
constexpr int kDefaultIterations = 1000;

// The last iteration that the settings and the budget allow: eq. (14) runs its course up to there.
int LastIteration(const Settings& settings, const Budget& budget) {
  const std::int64_t batches = std::max<std::int64_t>(budget.max_evaluations - 1, 0) / settings.swarm_size;
  const int wanted =
      settings.iterations.value_or(budget.LimitsEvaluations() ? kUnlimitedIterations : kDefaultIterations);
  return static_cast<int>(std::min<std::int64_t>(wanted, batches));
}

int MaxIterations(const Settings& settings, const Budget& budget) {
  return settings.iterations.value_or(budget.IsLimited() ? kUnlimitedIterations : kDefaultIterations);
}

void CheckGuesses(const Settings& settings, const SearchBox& box) {
  const std::size_t dimensions = box.size();
  if (settings.guesses.size() % std::max<std::size_t>(dimensions, 1) != 0) {
    throw ConfigError("option 'guesses' of solver 'pso' has " + std::to_string(settings.guesses.size()) +
                      " values, expected a multiple of the " + std::to_string(dimensions) +
                      " free parameters");
  }
  const std::size_t starts = settings.guesses.size() / std::max<std::size_t>(dimensions, 1);
  if (starts + (settings.start_at_guess ? 1 : 0) > static_cast<std::size_t>(settings.swarm_size)) {
    throw ConfigError("option 'guesses' of solver 'pso' holds " + std::to_string(starts) +
                      " guesses, more than 'swarm_size' " + std::to_string(settings.swarm_size) +
                      " has particles for");
  }
  for (std::size_t k = 0; k < settings.guesses.size(); ++k) {
    const std::size_t d = k % box.size();
    if (settings.guesses[k] >= box.lower[d] && settings.guesses[k] <= box.upper[d]) continue;
    throw ConfigError("option 'guesses' of solver 'pso': value " + std::to_string(k + 1) + ", " +
                      FormatValue(settings.guesses[k]) + ", is outside of the fit's bounds " +
                      FormatValue(std::vector<double>{box.lower[d], box.upper[d]}));
  }
}

void EvaluateAll(ParticleSwarm* swarm, SearchedObjective* objective) {
  std::vector<double> objectives(static_cast<std::size_t>(swarm->size()));
  objective->Evaluate(swarm->positions(), objectives);
  for (int i = 0; i < swarm->size(); ++i) swarm->Learn(i, objectives[static_cast<std::size_t>(i)]);
}

// Stops as soon as the budget says so.
void MoveOneByOne(double inertia_weight, ParticleSwarm* swarm, SearchedObjective* objective) {
  swarm->BeginMove();
  for (int i = 0; i < swarm->size() && !objective->Cause(); ++i) {
    swarm->MoveOne(i, inertia_weight);
    double value = 0;
    objective->Evaluate({swarm->Position(i), objective->box().size()}, {&value, 1});
    swarm->Learn(i, value);
  }
}

class ParticleSwarmSolver final : public Solver {
 public:
  ParticleSwarmSolver(Settings settings, OptionValue start_box)
      : settings_(std::move(settings)), start_box_(std::move(start_box)) {}

  void Check(const FitProblem& fit) const override { CheckedBox(fit); }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    const QuietCeresLog quiet;
    const SearchBox box = CheckedBox(fit);
    SolverReport report;
    SearchedObjective objective(fit, box, budget, context.threads, &report);
    if (objective.FinishedWithoutSearch()) return report;
    Random random(context.seed);
    ParticleSwarm swarm(box, settings_, &random);

    const int last = LastIteration(settings_, budget), most = MaxIterations(settings_, budget);
    EvaluateAll(&swarm, &objective);
    for (int iteration = 0;; ++iteration) {
      std::optional<Termination> cause = objective.Cause();
      if (!cause && (iteration >= most || !std::isfinite(swarm.best_objective()))) {
        cause = Termination::kIterationLimit;
      }
      if (cause) {
        objective.Finish(*cause, StopMessage(*cause), iteration);
        return report;
      }
      const double inertia = InertiaWeight(settings_.inertia, iteration + 1, last);
      if (settings_.asynchronous) {
        MoveOneByOne(inertia, &swarm, &objective);
      } else {
        swarm.Move(inertia);
        EvaluateAll(&swarm, &objective);
      }
    }
  }

 private:
  SearchBox CheckedBox(const FitProblem& fit) const {
    SearchBox box = MakeSearchBox(fit, start_box_, "pso");
    if (box.size() > 0) CheckGuesses(settings_, box);
    return box;
  }

  Settings settings_;
  OptionValue start_box_;
};

SwarmTopology TopologyFrom(const std::string& name, Settings::Method method) {
  if (name == "gbest") return SwarmTopology::kGlobal;
  if (name == "ring") return SwarmTopology::kRing;
  if (name == "von_neumann") return SwarmTopology::kVonNeumann;
  if (name == "random") return SwarmTopology::kRandom;
  switch (method) {  // auto
    case Settings::Method::kStandard2011:
      return SwarmTopology::kRandom;
    case Settings::Method::kFullyInformed:
      return SwarmTopology::kRing;
    case Settings::Method::kCanonical:
      break;
  }
  return SwarmTopology::kGlobal;
}

}  // namespace

std::vector<OptionSpec> ParticleSwarmSpecs() {
  const Settings defaults;
  return {
      ChoiceSpec("method", {"canonical", "fips", "spso2011"},
                 "canonical: the leaf paper's eqs 12 and 13; fips: pulled by all informants; spso2011: "
                 "Clerc's standard, blind to rotations"),
      IntegerSpec("swarm_size", defaults.swarm_size, 1, 1e9, "Particles (the leaf paper: 5)"),
      AutoIntegerSpec("iterations", 0, kUnlimitedIterations,
                      "Moves of the swarm (the leaf paper: 10); auto: all that a budget allows, "
                      "1000 without one"),
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
      ChoiceSpec(
          "topology", {"auto", "gbest", "ring", "von_neumann", "random"},
          "Who informs whom: everyone, two neighbours, four on a torus, some drawn at random; auto: gbest, "
          "ring for fips, random for spso2011"),
      ChoiceSpec("update", {"synchronous", "asynchronous"},
                 "synchronous: all move, then all are evaluated, in parallel; asynchronous: one by one, each "
                 "learning "
                 "from those before it"),
      IntegerSpec("informed", defaults.informed, 1, 1e6,
                  "Particles that each one informs (topology: random)"),
      StartBoxSpec(),
      FlagSpec("start_at_guess", defaults.start_at_guess, "Put the first particle at the fit's start"),
      {.name = "guesses",
       .type = OptionType::kNumbers,
       .default_value = std::string("none"),
       .help = "Where further particles start: the free parameters' values, one guess after the other",
       .words = {"none"},
       .max_size = 10'000'000},
  };
}

ParticleSwarmSettings ParticleSwarmSettingsFrom(const Options& options) {
  Settings settings;
  if (options.Text("method") == "spso2011") {
    settings.method = Settings::Method::kStandard2011;
    RefuseSet(options, {"inertia", "cognitive", "social", "velocity_limit", "boundary"}, "method: spso2011");
  }
  if (options.Text("method") == "fips") settings.method = Settings::Method::kFullyInformed;
  settings.swarm_size = options.Integer("swarm_size");
  if (!options.HoldsWord("iterations")) settings.iterations = options.Integer("iterations");
  settings.inertia =
      options.Text("inertia") == "linear" ? Settings::Inertia::kLinear : Settings::Inertia::kConstriction;
  settings.cognitive = options.Number("cognitive");
  settings.social = options.Number("social");
  settings.velocity_limit = options.Number("velocity_limit");
  const std::string& boundary = options.Text("boundary");
  settings.boundary = boundary == "clamp"    ? Settings::Boundary::kClamp
                      : boundary == "absorb" ? Settings::Boundary::kAbsorb
                                             : Settings::Boundary::kReflect;
  settings.topology = TopologyFrom(options.Text("topology"), settings.method);
  if (settings.topology == SwarmTopology::kVonNeumann && TorusRows(settings.swarm_size) < 2) {
    throw ConfigError("option 'swarm_size' is " + std::to_string(settings.swarm_size) +
                      ", which makes no torus for 'topology: von_neumann': take a product, such as 4 * 5");
  }
  if (settings.topology != SwarmTopology::kRandom) {
    RefuseSet(options, {"informed"}, "topology: " + options.Text("topology"));
  }
  settings.informed = options.Integer("informed");
  settings.asynchronous = options.Text("update") == "asynchronous";
  settings.start_at_guess = options.Flag("start_at_guess");
  if (!options.HoldsWord("guesses")) settings.guesses = options.Numbers("guesses");
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
