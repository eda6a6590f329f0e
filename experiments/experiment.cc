// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/experiment.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "base/errors.h"
#include "experiments/message.h"
#include "experiments/named_errors.h"
#include "experiments/study/study_plan.h"
#include "experiments/sweep.h"
#include "experiments/version.h"
#include "io/run_directory.h"

namespace frond {
namespace {

constexpr char kDefaultSolver[] = "lm";

// A registry's own complaint, with the config's place in front.
template <typename Find>
const auto& FindAt(const ConfigFile& config, const std::string& key, const Find& find) {
  const std::string name = config.Text(key);
  try {
    return find(name);
  } catch (const ConfigError& error) {
    config.Fail(key, error.what());
  }
}

// The fit's defaults are set, not made defaults of the specs: a solver inside another one (pso in pso_lm) is
// given what was set.
Options SolverOptions(const ConfigFile& config, const FitType& fit, const Options& problem,
                      const SolverType& solver) {
  Options options(solver.options);
  config.ReadSection("solver", &options, {"type"});
  const auto known = [&](const std::string& name) {
    return std::any_of(solver.options.begin(), solver.options.end(),
                       [&](const auto& s) { return s.name == name; });
  };
  for (auto& [name, value] : fit.solver_defaults(problem, solver.name)) {
    if (known(name) && !options.IsSet(name)) options.Set(name, value);
  }
  return options;
}

Budget ReadBudget(const ConfigFile& config) {
  config.CheckKeys("budget", {"evaluations", "seconds", "target", "stall"});
  Budget budget;
  if (config.Has("budget.evaluations")) {
    budget.max_evaluations = config.Integer("budget.evaluations");
    if (budget.max_evaluations < 1) config.Fail("budget.evaluations", "'evaluations' must be at least 1");
  }
  if (config.Has("budget.seconds")) {
    budget.max_seconds = config.Number("budget.seconds");
    if (!(budget.max_seconds > 0)) config.Fail("budget.seconds", "'seconds' must be above 0");
  }
  if (config.Has("budget.target")) budget.target_objective = config.Number("budget.target");
  if (config.Has("budget.stall")) {
    budget.stall_evaluations = config.Integer("budget.stall");
    if (budget.stall_evaluations < 1) config.Fail("budget.stall", "'stall' must be at least 1");
  }
  return budget;
}

std::vector<std::string> ReadFormats(const ConfigFile& config, const std::vector<std::string>& known) {
  config.CheckKeys("output", {"formats", "plot"});
  if (known.empty()) return {};
  if (!config.Has("output.formats")) return {"json", "step", "ply"};
  std::vector<std::string> formats = config.Texts("output.formats");
  for (const std::string& format : formats) {
    if (std::find(known.begin(), known.end(), format) != known.end()) continue;
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    config.Fail("output.formats", "unknown format '" + format + "'; known: " + all);
  }
  return formats;
}

std::int64_t PeakRssBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

void FillSolver(const Experiment& experiment, const FitOutcome& outcome, RunMetrics* metrics) {
  metrics->solver.name = outcome.report ? experiment.solver_type : "none";
  if (!outcome.report) {
    metrics->solver.termination = "not_needed";
    return;
  }
  const SolverReport& report = *outcome.report;
  metrics->solver = {.name = experiment.solver_type,
                     .termination = TerminationName(report.termination),
                     .objective = report.objective,
                     .evaluations = report.evaluations,
                     .residual_evaluations = report.residual_evaluations,
                     .jacobian_evaluations = report.jacobian_evaluations,
                     .iterations = report.iterations,
                     .seconds = report.seconds};
}

using Progress = std::function<void(const std::string& line)>;

// One line of a terminal, each time over the last one.
void ShowProgress(const std::string& line) { std::cerr << "\r\033[K" << line << std::flush; }

// What reading the input did to it.
void SetInputMetrics(const RunInput& input, MetricTable* metrics) {
  const auto set = [&](const char* name, auto count) {
    metrics->Set(name, static_cast<std::int64_t>(count));
  };
  if (input.stereo || input.turntable) return;
  set("dropped_not_finite", input.report.dropped_not_finite);
  set("merged_duplicates", input.report.merged_duplicates);
  if (input.repaired) {
    set("repaired_welded_vertices", input.repaired->welded_vertices);
    set("repaired_degenerate_faces", input.repaired->degenerate_faces);
    set("repaired_duplicate_faces", input.repaired->duplicate_faces);
    set("repaired_swapped_edges", input.repaired->swapped_edges);
    set("repaired_split_vertices", input.repaired->split_vertices);
    set("repaired_unreferenced_vertices", input.repaired->unreferenced_vertices);
  }
  if (input.outside_region) set("region_dropped", *input.outside_region);
}

}  // namespace

ResolvedConfig Experiment::Resolved() const {
  ResolvedConfig resolved;
  resolved.Add("name", name);
  resolved.Add("seed", static_cast<std::int64_t>(seed));
  AddInput(input, &resolved);
  resolved.Add("problem.type", problem_type);
  const FitType& fit = FindFitType(problem_type);
  if (fit.input != InputKind::kNone) {
    resolved.AddSection("problem", problem);
  } else {  // of the sets, only what is set: the others' options would stand there without effect
    for (const OptionSpec& spec : problem.specs()) {
      if (problem.IsSet(spec.name)) resolved.Add("problem." + spec.name, problem.Value(spec.name));
    }
  }
  resolved.Add("solver.type", solver_type);
  resolved.AddSection("solver", solver);
  const Budget none;
  if (budget.max_evaluations != none.max_evaluations)
    resolved.Add("budget.evaluations", budget.max_evaluations);
  if (budget.max_seconds != none.max_seconds) resolved.Add("budget.seconds", budget.max_seconds);
  if (budget.target_objective != none.target_objective)
    resolved.Add("budget.target", budget.target_objective);
  if (budget.stall_evaluations != none.stall_evaluations)
    resolved.Add("budget.stall", budget.stall_evaluations);
  if (!fit.formats.empty()) resolved.Add("output.formats", formats);
  return resolved;
}

Experiment ReadExperiment(const ConfigFile& config, const RunFlags& flags) {
  config.CheckKeys("", {"name", "seed", "input", "problem", "solver", "budget", "output", "sweep"});
  if (!config.Has("problem.type"))
    config.Fail("problem", "'problem.type' is missing; `frond list fits` names them");
  const FitType& fit = FindAt(config, "problem.type", FindFitType);
  Options problem(fit.options);
  config.ReadSection("problem", &problem, {"type"});
  if (fit.dependent_defaults) {
    for (auto& [option, value] : fit.dependent_defaults(problem)) {
      if (!problem.IsSet(option)) problem.Set(option, value);
    }
  }
  try {
    fit.check(problem);
  } catch (const ConfigError& error) {
    config.Fail("problem", error.what());
  }
  const SolverType& solver = config.Has("solver.type") ? FindAt(config, "solver.type", FindSolverType)
                                                       : FindSolverType(kDefaultSolver);
  Options solver_options = SolverOptions(config, fit, problem, solver);
  try {
    (void)solver.create(solver_options);
  } catch (const ConfigError& error) {
    config.Fail("solver", error.what());
  }
  try {
    if (fit.check_solver) fit.check_solver(problem, solver.name);
  } catch (const ConfigError& error) {
    config.Fail("solver", error.what());
  }
  if (fit.input == InputKind::kNone && config.Has("input")) {
    config.Fail("input", "a fit of type '" + fit.name + "' takes no input: leave 'input' out");
  }
  if (fit.input == InputKind::kScan && !fit.has_walls && config.Has("input.other_wall")) {
    config.Fail("input.other_wall", "a fit of type '" + fit.name + "' has no walls: leave 'other_wall' out");
  }
  if (fit.formats.empty() && config.Has("output.formats")) {
    config.Fail("output.formats", "a fit of type '" + fit.name + "' has no surface: leave 'formats' out");
  }
  InputSource input = ReadInputSource(config, fit.input);
  try {
    if (fit.check_input) fit.check_input(input, problem);
  } catch (const ConfigError& error) {
    config.Fail("problem", error.what());
  }
  const std::int64_t seed = config.Integer("seed", 0);
  if (seed < 0) config.Fail("seed", "'seed' must not be negative");
  std::string name = config.Text("name", std::filesystem::path(config.name()).stem().string());
  if (name.empty() || name.find('/') != std::string::npos || name.front() == '.') {
    config.Fail("name", "'name' must be usable as a folder's name, without '/' and not starting with '.'");
  }
  return {.name = std::move(name),
          .seed = flags.seed.value_or(static_cast<std::uint64_t>(seed)),
          .input = std::move(input),
          .problem_type = fit.name,
          .problem = std::move(problem),
          .solver_type = solver.name,
          .solver = std::move(solver_options),
          .budget = ReadBudget(config),
          .formats = ReadFormats(config, fit.formats)};
}

RunResult RunExperiment(const Experiment& experiment, int threads,
                        const std::function<void(const std::string& line)>& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const auto solver = FindSolverType(experiment.solver_type).create(experiment.solver);
  RunResult result{LoadInput(experiment.input, experiment.seed), {}, {}};
  StageClock clock;
  const auto fit = [&] {
    return FindFitType(experiment.problem_type)
        .run(result.input, experiment.problem, *solver, experiment.budget,
             {{.threads = threads, .seed = experiment.seed}, progress});
  };
  // Fits of photographs have several inputs, and name themselves the one that is wrong.
  const bool photographs = result.input.stereo || result.input.turntable;
  result.outcome = photographs ? fit() : NameErrors(result.input.description, fit);
  RunMetrics& metrics = result.metrics;
  metrics.problem = experiment.problem_type;
  metrics.unit = result.input.unit;
  metrics.input = {.path = result.input.description,
                   .sha256 = result.input.report.sha256,
                   .points = static_cast<std::int64_t>(result.Cloud().points.size())};
  metrics.metrics = result.outcome.metrics;
  SetInputMetrics(result.input, &metrics.metrics);
  metrics.metrics.Set("warnings", result.outcome.warnings);
  FillSolver(experiment, result.outcome, &metrics);
  for (const StageTime& stage : result.outcome.stages) metrics.stages.push_back({stage.name, stage.seconds});
  metrics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  metrics.peak_rss_bytes = PeakRssBytes();
  metrics.threads = threads;
  metrics.seed = experiment.seed;
  metrics.versions = VersionTable();
  return result;
}

std::filesystem::path FitConfig(const std::filesystem::path& config_path, const RunFlags& flags,
                                const std::filesystem::path& out, bool overwrite, bool progress) {
  ConfigFile config = ConfigFile::Load(config_path);
  if (!flags.set.empty()) config.Override(flags.set);
  if (IsStudy(config)) {
    throw ConfigError(config.name() + ": is a study's config (it has 'problems'); run it with `frond study`");
  }
  if (config.Has("sweep")) return RunSweep(config, flags, out, overwrite, progress);
  const Experiment experiment = ReadExperiment(config, flags);
  const std::filesystem::path target = out.empty() ? std::filesystem::path("runs") / experiment.name : out;
  { const RunDirectory writable(target, overwrite); }  // refuse an existing target before the work, not after
  const RunResult result = RunExperiment(experiment, flags.threads, progress ? ShowProgress : Progress());
  if (progress) ShowProgress("");
  WriteRun(experiment, result, target, overwrite);
  for (const std::string& warning : result.outcome.warnings) {
    PrintMessage("warning: " + result.input.description + ": " + warning);
  }
  return target;
}

}  // namespace frond
