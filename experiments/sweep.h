// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "experiments/experiment.h"

namespace frond {

// All runs of a config's `sweep`, crossed, first axis slowest. Every run's config is validated before the
// first one starts. Into the folder `out` (runs/NAME if empty), all or nothing:
//
//   config.yaml   what the config sets (paths absolute), with its sweep; defaults may differ between runs
//   runs.csv      one row a run: the swept values, status, error, number of warnings, every numeric metric
//   summary.csv   the means over `seed` (an axis) for each combination of the others, of the runs that worked
//   plot.svg      where output.plot is given: {x: AXIS, y: [METRIC, …]}, one line per combination of the rest
//
// A run that throws InputError or FitError is a row with its error; the sweep goes on, and a line on stderr
// counts them at the end. If no run worked, throws what the first one threw.
std::filesystem::path RunSweep(const ConfigFile& config, const RunFlags& flags,
                               const std::filesystem::path& out, bool overwrite, bool progress);

// Validates a config and every run of its sweep, without running any; returns how many runs there are. Throws
// ConfigError.
std::size_t CheckConfig(const std::filesystem::path& config, const RunFlags& flags);

}  // namespace frond
