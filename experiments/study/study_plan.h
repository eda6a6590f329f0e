// SPDX-License-Identifier: BSD-3-Clause
// What a study will run, fixed before the first run: problems × solvers × budgets × repetitions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "io/config_file.h"
#include "problems/standard/problem_set.h"
#include "solvers/solver.h"

namespace frond {

// What an objective f has to come down to, to count as reached at τ, with f_L the least objective known
// (published, or the best of all runs of the study) and f₀ that of the run's start.
enum class TargetScale {
  kStart,     // f ≤ f_L + τ (f₀ − f_L): Moré and Wild 2009
  kRelative,  // f ≤ f_L + τ |f_L|
  kAbsolute,  // f ≤ f_L + τ
};

// The section `study`.
struct StudySettings {
  int repetitions = 15;
  bool random_starts =
      false;             // each repetition starts at a point drawn in the fit's start box; else at the fit's
  double target = 1e-5;  // τ of success
  TargetScale scale = TargetScale::kStart;
  bool stop_at_target = true;  // where f_L is published: a run ends on success
  std::vector<double> profile_targets = {1e-1, 1e-3, 1e-5,
                                         1e-7};  // τ of run-length distributions and profiles
  std::string
      question;  // a solver's label: the report says of every other how much sooner this one gets there
  double time_limit = 600;  // seconds of a job, after which it is killed
  int part = 1,
      parts = 1;  // for several machines: every parts-th repetition of a problem, with all contenders
};

// f_L + the allowance of τ, at least the problem's resolution; without an allowance where `start` is not
// finite.
double TargetObjective(TargetScale scale, double tau, double least, double start, double resolution);

struct StudyProblem {
  std::string name;  // LABEL of the config, or LABEL.PROBLEM where the label stands for several
  std::string set;
  Options options;
  TestProblem problem;
  std::string input_hash = {};  // SHA-256 of the scan (`cloud`); empty without one
};

struct StudySolver {
  std::string label;
  std::string type;
  Options options;
};

// A solver with a budget: what is compared.
struct Contender {
  std::string name;  // the solver's label, "LABEL@10000" where there are several budgets
  std::size_t solver = 0;
  Budget budget;
};

struct StudyJob {
  std::size_t problem = 0, contender = 0;
  int repetition = 0;
  std::string key;  // hash of all that decides the result: set, problem, solver, options, seeds, budget,
                    // frond's version
};

struct StudyPlan {
  std::string name;
  std::uint64_t seed = 0;
  StudySettings settings;
  std::vector<StudyProblem> problems;
  std::vector<StudySolver> solvers;
  std::vector<Contender> contenders;
  std::vector<StudyJob> jobs;  // problem by problem, then repetition, then contender
  std::string config;          // resolved, as YAML

  // One line a job: its key and what it is. Two plans are the same if these bytes are.
  std::string Csv() const;

  // Of a repetition of a problem, for every contender the same: (study's seed, name of the problem,
  // repetition).
  std::uint64_t JobSeed(const StudyJob& job) const;
};

// Takes the jobs' keys from a plan.csv of the same study, written by whatever version of frond. `path` stands
// for it in messages. Throws InputError where it holds other jobs.
void AdoptKeys(const std::string& csv, const std::filesystem::path& path, StudyPlan* plan);

// Whether `config` is one of a study (it has `problems`).
bool IsStudy(const ConfigFile& config);

// Throws ConfigError with the place of anything that is wrong, unknown or missing.
StudyPlan ReadStudyPlan(const ConfigFile& config, const RunFlags& flags);

}  // namespace frond
