// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/fit_type.h"
#include "io/config_file.h"

namespace frond {

// What the command line may say beside the config.
struct RunFlags {
  std::string set;                    // --set
  std::optional<std::uint64_t> seed;  // --seed
  int threads = 1;
};

// One validated run: everything a config says, checked before anything is read but the config.
struct Experiment {
  std::string name;
  std::uint64_t seed = 0;
  InputSource input;
  std::string problem_type;
  Options problem;
  std::string solver_type;
  Options solver;
  Budget budget;
  std::vector<std::string> formats;

  ResolvedConfig Resolved() const;  // repeats this run, defaults included
};

// Throws ConfigError with file, line and column for anything that is wrong, unknown or missing. `sweep` is
// not looked at.
Experiment ReadExperiment(const ConfigFile& config, const RunFlags& flags);

struct RunResult {
  RunInput input;
  FitOutcome outcome;
  RunMetrics metrics;

  // The points that the fit is of: the input's, or those made of its photographs.
  const PointCloud& Cloud() const { return outcome.cloud ? *outcome.cloud : input.cloud; }
};

// Reads the input and fits. Throws InputError and FitError that name the input. `progress` is told how far
// long work is (RunContext).
RunResult RunExperiment(const Experiment& experiment, int threads,
                        const std::function<void(const std::string& line)>& progress = {});

// Writes the run directory of a result: config.yaml, metrics.json, trace.csv, the surface in the formats
// asked for, deviation.ply, outliers.csv, the fit's own files, log.txt. All or nothing (RunDirectory).
void WriteRun(const Experiment& experiment, const RunResult& result, const std::filesystem::path& target,
              bool overwrite);

// `frond fit`: a single run, or all runs of a `sweep`, into `out` (runs/NAME if empty). Returns the folder.
// Progress goes to stderr where `progress` is set.
std::filesystem::path FitConfig(const std::filesystem::path& config, const RunFlags& flags,
                                const std::filesystem::path& out, bool overwrite, bool progress);

}  // namespace frond
