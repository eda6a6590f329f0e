// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/pagmo_solvers.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <span>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "base/refuse_set.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/searched_objective.h"

namespace frond {
namespace {

constexpr int kDefaultGenerations = 1000;  // without a budget
constexpr int kUnlimitedGenerations = 1'000'000'000;

// Thrown through pagmo when no other evaluation may begin.
struct SearchStopped {};

// What all copies that pagmo makes share.
struct Search {
  SearchedObjective* objective = nullptr;
  std::exception_ptr error = nullptr;  // thrown by the fit, not by pagmo

  void Evaluate(std::span<const double> points, std::span<double> objectives) {
    try {
      objective->Evaluate(points, objectives);
    } catch (...) {
      error = std::current_exception();
      throw;
    }
  }
};

// The objective as a pagmo problem.
struct Udp {
  Search* search = nullptr;
  pagmo::vector_double lower, upper;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    pagmo::vector_double value(1);
    search->Evaluate(x, value);
    if (std::isnan(value[0]) || search->objective->Cause()) throw SearchStopped();
    return {std::min(value[0], kWorstObjective)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const { return {lower, upper}; }
};

// A generation in one call, on the threads of the objective.
struct BatchEvaluator {
  Search* search = nullptr;

  pagmo::vector_double operator()(const pagmo::problem& /*problem*/,
                                  const pagmo::vector_double& points) const {
    pagmo::vector_double values(points.size() / search->objective->box().size());
    search->Evaluate(points, values);
    if (search->objective->Cause()) throw SearchStopped();
    for (double& value : values) value = std::min(value, kWorstObjective);
    return values;
  }
};

struct AlgorithmContext {
  unsigned generations;
  unsigned seed;
  bool bounded;  // the fit has bounds for every value
  Search* search;
};
using MakeAlgorithm = std::function<pagmo::algorithm(const Options&, const AlgorithmContext&)>;

Udp MakeUdp(Search* search) {
  const SearchBox& box = search->objective->box();
  Udp udp{search, box.lower, box.upper};
  for (std::size_t d = 0; d < box.size(); ++d) {
    if (!std::isfinite(udp.lower[d])) udp.lower[d] = box.start_lower[d];
    if (!std::isfinite(udp.upper[d])) udp.upper[d] = box.start_upper[d];
  }
  return udp;
}

pagmo::vector_double Clamped(std::vector<double> x, const Udp& udp) {
  for (std::size_t d = 0; d < x.size(); ++d) x[d] = std::clamp(x[d], udp.lower[d], udp.upper[d]);
  return x;
}

class PagmoSolver final : public Solver {
 public:
  PagmoSolver(std::string name, Options options, MakeAlgorithm make)
      : name_(std::move(name)), options_(std::move(options)), make_(std::move(make)) {}

  void Check(const FitProblem& fit) const override { MakeSearchBox(fit, options_.Value("start_box"), name_); }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    const QuietCeresLog quiet;
    const SearchBox box = MakeSearchBox(fit, options_.Value("start_box"), name_);
    SolverReport report;
    SearchedObjective objective(fit, box, budget, context.threads, &report);
    if (objective.FinishedWithoutSearch()) return report;
    const int size = options_.Integer("population_size");
    Termination cause = Termination::kConverged;
    Search search{.objective = &objective};
    try {
      Random random(context.seed);
      const Udp udp = MakeUdp(&search);
      pagmo::population population{pagmo::problem(udp), 0U, static_cast<unsigned>(random.NextBits())};
      for (int i = 0; i < size; ++i) {
        const bool at_guess = i == 0 && options_.Flag("start_at_guess");
        const std::vector<double> drawn = box.RandomPoint(&random);
        population.push_back(Clamped(at_guess ? box.StartPoint() : drawn, udp));
      }
      if (!std::isfinite(objective.best_objective())) throw SearchStopped();
      const int generations = Generations(budget);
      const AlgorithmContext algorithm_context{static_cast<unsigned>(generations),
                                               static_cast<unsigned>(random.NextBits()), IsBounded(box),
                                               &search};
      make_(options_, algorithm_context).evolve(population);
      // Without tolerances met all generations have run, of one evaluation an individual at least.
      if (report.evaluations >= static_cast<std::int64_t>(size) * (generations + std::int64_t{1})) {
        cause = Termination::kIterationLimit;
      }
    } catch (const SearchStopped&) {
      cause = objective.Cause().value_or(Termination::kFailed);
    } catch (const std::invalid_argument& error) {
      if (search.error != nullptr) std::rethrow_exception(search.error);
      throw ConfigError("solver '" + name_ + "' does not take this fit: " + FirstLine(error.what()));
    }
    objective.Finish(cause, StopMessage(cause), std::max(0, static_cast<int>(report.evaluations / size) - 1));
    return report;
  }

 private:
  static bool IsBounded(const SearchBox& box) {
    const auto finite = [](double x) { return std::isfinite(x); };
    return std::all_of(box.lower.begin(), box.lower.end(), finite) &&
           std::all_of(box.upper.begin(), box.upper.end(), finite);
  }

  // pagmo's messages give function and line above the cause.
  static std::string FirstLine(std::string text) {
    const std::size_t what = text.rfind("what: ");
    if (what != std::string::npos) text = text.substr(what + 6);
    return text.substr(0, text.find('\n'));
  }

  int Generations(const Budget& budget) const {
    if (!options_.HoldsWord("generations")) return options_.Integer("generations");
    return budget.IsLimited() ? kUnlimitedGenerations : kDefaultGenerations;
  }

  std::string name_;
  Options options_;
  MakeAlgorithm make_;
};

std::vector<OptionSpec> PopulationSpecs(int least, int size) {
  return {IntegerSpec("population_size", size, least, 1e6, "Individuals"),
          AutoIntegerSpec("generations", 1, kUnlimitedGenerations,
                          "auto: all that a budget allows, 1000 without one"),
          StartBoxSpec(), FlagSpec("start_at_guess", true, "Put the first individual at the fit's start")};
}

// pagmo stops at 1e-6 by default, which leaves few digits (MATH.md §7).
void AddTolerances(std::vector<OptionSpec>* specs) {
  specs->push_back(
      NumberSpec("ftol", 1e-15, 0, 1, "Converged where the population's objectives differ by less"));
  specs->push_back(NumberSpec("xtol", 1e-15, 0, 1, "Converged where the population's points differ by less"));
}

SolverType Type(const std::string& name, const std::string& help, std::vector<OptionSpec> specs,
                MakeAlgorithm make) {
  return {"pagmo." + name, help, std::move(specs),
          [name, make](const Options& options) -> std::unique_ptr<Solver> {
            return std::make_unique<PagmoSolver>("pagmo." + name, options, make);
          }};
}

const std::vector<std::string> kSwarmVariants = {
    "constriction", "inertia", "inertia_equal_random", "inertia_common_random", "inertia_one_random", "fips"};

unsigned SwarmVariant(const std::string& name) {
  if (name == "inertia") return 1;
  if (name == "inertia_equal_random") return 2;
  if (name == "inertia_common_random") return 3;
  if (name == "inertia_one_random") return 4;
  return name == "fips" ? 6 : 5;
}

unsigned SwarmTopologyNumber(const std::string& name) {
  if (name == "gbest") return 1;
  if (name == "von_neumann") return 3;
  return name == "random" ? 4 : 2;
}

template <typename Swarm>
Swarm MakeSwarm(const Options& options, const AlgorithmContext& context) {
  return Swarm(context.generations, options.Number("omega"), options.Number("eta1"), options.Number("eta2"),
               options.Number("max_velocity"), SwarmVariant(options.Text("variant")),
               SwarmTopologyNumber(options.Text("topology")),
               static_cast<unsigned>(options.Integer("neighbours")), false, context.seed);
}

std::vector<OptionSpec> SwarmSpecs() {
  std::vector<OptionSpec> specs = PopulationSpecs(2, 40);
  specs.push_back(ChoiceSpec("variant", kSwarmVariants, "pagmo's velocity updates 5, 1, 2, 3, 4 and 6"));
  specs.push_back(ChoiceSpec("topology", {"ring", "gbest", "von_neumann", "random"},
                             "Who informs whom; ring is pagmo's lbest"));
  specs.push_back(IntegerSpec("neighbours", 4, 1, 1e6, "Of the ring, or most of the random topology"));
  specs.push_back(NumberSpec("omega", 0.7298, 0, 1, "Inertia, or constriction"));
  specs.push_back(NumberSpec("eta1", 2.05, 0, 4, "Pull towards the particle's own best"));
  specs.push_back(NumberSpec("eta2", 2.05, 0, 4, "Pull towards its neighbours' best"));
  specs.push_back(NumberSpec("max_velocity", 0.5, 1e-9, 1, "As a share of the box"));
  return specs;
}

SolverType SwarmTypeOf(const std::string& name, const std::string& help, MakeAlgorithm make) {
  SolverType type = Type(name, help, SwarmSpecs(), std::move(make));
  type.create = [create = type.create](const Options& options) {
    const std::string& topology = options.Text("topology");
    if (topology == "gbest" || topology == "von_neumann") {
      RefuseSet(options, {"neighbours"}, "topology: " + topology);
    }
    return create(options);
  };
  return type;
}

SolverType SwarmType() {
  return SwarmTypeOf("pso", "pagmo's particle swarm, particle by particle",
                     [](const Options& options, const AlgorithmContext& context) {
                       return pagmo::algorithm(MakeSwarm<pagmo::pso>(options, context));
                     });
}

SolverType GenerationalSwarmType() {
  return SwarmTypeOf("pso_gen", "pagmo's particle swarm, by generations",
                     [](const Options& options, const AlgorithmContext& context) {
                       auto swarm = MakeSwarm<pagmo::pso_gen>(options, context);
                       swarm.set_bfe(pagmo::bfe(BatchEvaluator{context.search}));
                       return pagmo::algorithm(std::move(swarm));
                     });
}

SolverType CmaesType() {
  std::vector<OptionSpec> specs = PopulationSpecs(5, 40);
  specs.push_back(NumberSpec("sigma0", 0.5, 1e-12, 1e6, "First step, as a share of the box"));
  AddTolerances(&specs);
  return Type("cmaes", "pagmo's covariance matrix adaptation evolution strategy", std::move(specs),
              [](const Options& options, const AlgorithmContext& context) {
                return pagmo::algorithm(pagmo::cmaes(
                    context.generations, -1, -1, -1, -1, options.Number("sigma0"), options.Number("ftol"),
                    options.Number("xtol"), false, context.bounded, context.seed));
              });
}

unsigned SelfAdaptation(const Options& options) { return options.Text("adaptation") == "ide" ? 2 : 1; }

void AddSelfAdaptation(std::vector<OptionSpec>* specs) {
  specs->push_back(ChoiceSpec("adaptation", {"jde", "ide"}, "How F and CR adapt themselves"));
}

SolverType SadeType() {
  std::vector<OptionSpec> specs = PopulationSpecs(7, 40);
  specs.push_back(IntegerSpec("variant", 2, 1, 18, "pagmo's mutation variant; 2 is rand/1/exp"));
  AddSelfAdaptation(&specs);
  AddTolerances(&specs);
  return Type("sade", "pagmo's self-adaptive differential evolution", std::move(specs),
              [](const Options& options, const AlgorithmContext& context) {
                return pagmo::algorithm(pagmo::sade(context.generations,
                                                    static_cast<unsigned>(options.Integer("variant")),
                                                    SelfAdaptation(options), options.Number("ftol"),
                                                    options.Number("xtol"), false, context.seed));
              });
}

SolverType De1220Type() {
  std::vector<OptionSpec> specs = PopulationSpecs(7, 40);
  AddSelfAdaptation(&specs);
  AddTolerances(&specs);
  return Type("de1220", "pagmo's differential evolution that adapts its variant too", std::move(specs),
              [](const Options& options, const AlgorithmContext& context) {
                return pagmo::algorithm(pagmo::de1220(context.generations,
                                                      pagmo::de1220_statics<void>::allowed_variants,
                                                      SelfAdaptation(options), options.Number("ftol"),
                                                      options.Number("xtol"), false, context.seed));
              });
}

SolverType BeeColonyType() {
  std::vector<OptionSpec> specs = PopulationSpecs(2, 40);
  specs.push_back(IntegerSpec("limit", 20, 1, 1e9, "Trials before a source is abandoned"));
  return Type("bee_colony", "pagmo's artificial bee colony", std::move(specs),
              [](const Options& options, const AlgorithmContext& context) {
                return pagmo::algorithm(pagmo::bee_colony(
                    context.generations, static_cast<unsigned>(options.Integer("limit")), context.seed));
              });
}

}  // namespace

std::vector<SolverType> PagmoSolverTypes() {
  return {SwarmType(), GenerationalSwarmType(), CmaesType(), SadeType(), De1220Type(), BeeColonyType()};
}

}  // namespace frond
