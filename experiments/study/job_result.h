// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/metrics_json.h"
#include "solvers/solver.h"

namespace frond {

// What one job of a study gave, good or bad: file jobs/KEY.json, schema frond.job/1.
struct JobResult {
  std::string key, problem, contender;
  int repetition = 0;
  std::string status = "ok";   // "ok"; "failed": the solver or the problem threw, or found no finite
                               // objective; "timeout": killed at its time limit; "crashed"
  std::string reason;          // in words, where not ok
  double start_objective = 0;  // NaN where not finite
  std::int64_t free_parameters = 0;
  SolverReport report;
  MetricTable metrics;  // the fit's, of the result

  bool ok() const { return status == "ok"; }
};

std::string FormatJobResult(const JobResult& result);

// Nothing where the file is absent. Throws InputError where it is not a whole result (cut off by a power
// failure).
std::optional<JobResult> ReadJobResult(const std::filesystem::path& path);

// Written beside and renamed: whole or absent.
void WriteJobResult(const std::filesystem::path& path, const JobResult& result);

}  // namespace frond
