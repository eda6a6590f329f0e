// SPDX-License-Identifier: BSD-3-Clause
// Studies that run in a second, and what lies in their folders.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/study/study_plan.h"

namespace frond {

// 2 problems × 4 solvers × 3 repetitions from random starts, batches of at most 10 evaluations.
inline constexpr char kSmallStudy[] = R"(name: small
seed: 5
problems:
  rosenbrock: {set: functions, function: rosenbrock, dimension: 2}
  sphere: {set: functions, function: sphere, dimension: 2}
solvers:
  lm: {}
  pso: {swarm_size: 10}
  cmaes: {type: pagmo.cmaes, population_size: 10}
  multistart_lm: {}
budget: {evaluations: 2000}
study: {repetitions: 3, starts: random}
)";

// The plan of a config called study.yaml.
StudyPlan PlanOf(const std::string& yaml, const RunFlags& flags = {});

// The rows of a CSV file by the names of their columns.
std::vector<std::map<std::string, std::string>> CsvRows(const std::filesystem::path& file);

// The text of a runs.csv without its last two columns, the times.
std::string RunsWithoutTimes(const std::filesystem::path& folder);

// A result's file: its bytes, and what tells whether it was written again.
struct FileState {
  std::string bytes;
  ino_t inode = 0;
  std::int64_t written = 0;  // nanoseconds

  bool operator==(const FileState&) const = default;
};

// All files of jobs/, by name.
std::map<std::string, FileState> ResultFiles(const std::filesystem::path& folder);

// A fit of two values in [-2, 2] from (1, 1) with one residual, `residual`, which may do what it likes.
std::shared_ptr<const FitProblem> FitOf(std::function<double(const double*)> residual);

}  // namespace frond
