// SPDX-License-Identifier: BSD-3-Clause
// `frond study`: runs what a plan holds, once each, and reports.
//
// The folder of a study appears whole with its plan (config.yaml, plan.csv), then fills: jobs/KEY.json for
// each job as it ends, at last runs.csv, traces/, summary.csv, summary.md and report.html. A study that was
// stopped, by whatever, goes on where it was: results that are there are never made again.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/study/job_result.h"
#include "experiments/study/study_plan.h"

namespace frond {

// One job, in this process: solves, or says why not. Keeps the last problem made, for the next job of the
// same.
class JobRunner {
 public:
  explicit JobRunner(const StudyPlan& plan) : plan_(plan) {}
  JobResult Run(const StudyJob& job);

 private:
  JobResult Solve(const StudyJob& job);

  const StudyPlan& plan_;
  std::size_t made_ = static_cast<std::size_t>(-1);
  std::shared_ptr<const FitProblem> fit_;
};

struct StudyOutcome {
  std::filesystem::path folder;
  std::size_t jobs = 0;     // of the plan
  std::size_t missing = 0;  // without a result yet (parts of other machines)
  std::size_t failed = 0;   // with a result that is a reason
  std::string text = {};    // the report for a terminal; empty while results are missing
};

struct StudyRunOptions {
  int workers = 1;         // processes
  bool overwrite = false;  // begin anew where the folder holds a run
  bool progress = false;   // to stderr
  std::vector<std::filesystem::path> merge =
      {};  // folders of the same study run elsewhere: results to take over first
};

// An existing folder is gone on with where its plan is this one, else refused (ConfigError) unless
// overwritten. Throws ConfigError and InputError.
StudyOutcome RunStudy(const StudyPlan& plan, const std::filesystem::path& folder,
                      const StudyRunOptions& options);

// `frond study`: the plan of a config. `out`: runs/NAME if empty.
StudyOutcome RunStudy(const std::filesystem::path& config, const RunFlags& flags,
                      const std::filesystem::path& out, const StudyRunOptions& options);

// `frond report`: writes the report of a study's folder again, from its results.
StudyOutcome ReportStudy(const std::filesystem::path& folder);

// `frond check`: the number of jobs.
std::size_t CheckStudy(const ConfigFile& config, const RunFlags& flags);

}  // namespace frond
