// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "experiments/message.h"
#include "experiments/study/study_analysis.h"
#include "experiments/study/study_lock.h"
#include "experiments/study/study_outputs.h"
#include "experiments/study/workers.h"
#include "io/file_bytes.h"
#include "io/run_directory.h"
#include "solvers/fit_from.h"
#include "solvers/search_box.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

constexpr char kPlanFile[] = "plan.csv";

fs::path ResultPath(const fs::path& folder, const StudyJob& job) {
  return folder / "jobs" / (job.key + ".json");
}

// Makes the folder, whole with its plan, or finds it there with the same one.
void PrepareFolder(const StudyPlan& plan, const fs::path& target, bool overwrite) {
  std::error_code error;
  if (fs::exists(target / kPlanFile, error)) {
    const StudyLock not_in_use(target);
    if (!overwrite && ReadFileBytes(target / kPlanFile) == plan.Csv()) return;
    if (!overwrite) {
      throw ConfigError(
          target.string() +
          ": holds another study, or this one begun by another version of frond; choose another "
          "--out, or give --overwrite");
    }
  }
  RunDirectory directory(target, overwrite);
  WriteFileBytes(directory.File("config.yaml"), plan.config);
  WriteFileBytes(directory.File(kPlanFile), plan.Csv());
  fs::create_directory(directory.File("jobs"), error);
  if (error) FailFile(directory.File("jobs"), "cannot be made: " + error.message());
  directory.Commit();
}

// The result of a job in `folder`, if there is one, under the names of this plan. Throws InputError where it
// is broken or another job's.
std::optional<JobResult> ReadResultOf(const StudyPlan& plan, const StudyJob& job, const fs::path& folder) {
  const fs::path path = ResultPath(folder, job);
  std::optional<JobResult> result = ReadJobResult(path);
  if (!result) return result;
  if (result->key != job.key || result->repetition != job.repetition) {
    FailFile(path, "holds the result of another job; delete it, and the study makes it again");
  }
  result->problem = plan.problems[job.problem].name;
  result->contender = plan.contenders[job.contender].name;
  return result;
}

// The results in `folder`, by job; none for jobs without. Broken files are named and removed where `mend` is
// set.
std::vector<std::optional<JobResult>> LoadResults(const StudyPlan& plan, const fs::path& folder, bool mend) {
  std::vector<std::optional<JobResult>> results;
  for (const StudyJob& job : plan.jobs) {
    try {
      results.push_back(ReadResultOf(plan, job, folder));
    } catch (const InputError& broken) {
      if (!mend) throw;
      const fs::path path = ResultPath(folder, job);
      PrintMessage("warning: " + path.string() + ": is not a whole result; the job is run again");
      fs::remove(path);
      results.emplace_back();
    }
  }
  return results;
}

// Removes what workers that were killed amid a write left behind (job_result.cc). Nobody else writes there.
void RemoveLeftovers(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(folder / "jobs")) {
    if (entry.path().filename().string().find(".json.partial-") != std::string::npos) {
      leftovers.push_back(entry.path());
    }
  }
  std::error_code ignored;
  for (const fs::path& leftover : leftovers) fs::remove(leftover, ignored);
}

// Before anything is replaced.
void CheckMerge(const std::vector<fs::path>& folders, const fs::path& target) {
  std::error_code error;
  for (const fs::path& from : folders) {
    if (!fs::is_directory(from / "jobs", error)) {
      throw ConfigError(from.string() + ": is not the folder of a study (it has no jobs)");
    }
    if (fs::equivalent(from, target, error)) {
      throw ConfigError(from.string() + ": is the study's own folder; name those of other machines");
    }
  }
}

// Takes over results that another machine made.
void Merge(const StudyPlan& plan, const fs::path& from, const fs::path& folder) {
  std::size_t found = 0;
  for (const StudyJob& job : plan.jobs) {
    const std::optional<JobResult> result = ReadResultOf(plan, job, from);
    if (!result) continue;
    ++found;
    if (!fs::exists(ResultPath(folder, job))) WriteJobResult(ResultPath(folder, job), *result);
  }
  if (found == 0) {
    throw ConfigError(from.string() +
                      ": has no results of this study; was it run with another config, seed or "
                      "version of frond?");
  }
}

// What of a config does not decide results (the targets that profiles show, the question) may differ from
// that of the run before: the folder then says what its report is made by.
void RefreshConfig(const StudyPlan& plan, const fs::path& folder) {
  const fs::path path = folder / "config.yaml", partial = folder / "config.yaml.partial";
  if (ReadFileBytes(path) == plan.config) return;
  WriteFileBytes(partial, plan.config);
  std::error_code error;
  fs::rename(partial, path, error);
  if (error) FailFile(path, "cannot be written: " + error.message());
}

class Progress {
 public:
  Progress(std::size_t total, bool shown) : total_(total), shown_(shown) {}

  void Done(bool failed) {
    ++done_;
    failed_ += failed ? 1 : 0;
    if (!shown_) return;
    std::cerr << "\r" << done_ << "/" << total_ << " jobs";
    if (failed_ > 0) std::cerr << ", " << failed_ << " failed";
    std::cerr << (done_ == total_ ? "\n" : "") << std::flush;
  }

 private:
  std::size_t total_, done_ = 0, failed_ = 0;
  bool shown_;
};

JobResult EmptyResult(const StudyPlan& plan, const StudyJob& job) {
  JobResult result;
  result.key = job.key;
  result.problem = plan.problems[job.problem].name;
  result.contender = plan.contenders[job.contender].name;
  result.repetition = job.repetition;
  result.start_objective = std::numeric_limits<double>::quiet_NaN();
  return result;
}

void RunJobs(const StudyPlan& plan, const std::vector<std::size_t>& pending, const fs::path& folder,
             const StudyRunOptions& options, StudyLock* lock) {
  if (pending.empty()) return;
  Progress progress(pending.size(), options.progress);
  JobRunner runner(plan);  // each worker has its own, by the fork
  WorkerCallbacks callbacks;
  callbacks.on_start = [&] { lock->CloseInChild(); };
  callbacks.run = [&](std::size_t index) {
    const StudyJob& job = plan.jobs[index];
    try {
      WriteJobResult(ResultPath(folder, job), runner.Run(job));
    } catch (const std::exception& error) {
      PrintMessage(error.what());  // this process then finds the result missing
    }
  };
  callbacks.finished = [&](std::size_t index) {
    const std::optional<JobResult> result = ReadResultOf(plan, plan.jobs[index], folder);
    if (!result) {
      FailFile(ResultPath(folder, plan.jobs[index]),
               "could not be written; the study stops here and can be resumed");
    }
    progress.Done(!result->ok());
  };
  callbacks.lost = [&](std::size_t index, const std::string& status, const std::string& reason) {
    // It may have written its result and died, or met its limit, just after.
    const StudyJob& job = plan.jobs[index];
    if (!fs::exists(ResultPath(folder, job))) {
      JobResult result = EmptyResult(plan, job);
      result.status = status;
      result.reason = reason;
      WriteJobResult(ResultPath(folder, job), result);
    }
    progress.Done(true);
  };
  RunInWorkers(pending, options.workers, plan.settings.time_limit, callbacks);
}

StudyOutcome Conclude(const StudyPlan& plan, const fs::path& folder) {
  StudyOutcome outcome{.folder = folder, .jobs = plan.jobs.size()};
  std::vector<JobResult> results;
  for (std::optional<JobResult>& result : LoadResults(plan, folder, false)) {
    if (!result) {
      ++outcome.missing;
      continue;
    }
    outcome.failed += result->ok() ? 0 : 1;
    results.push_back(std::move(*result));
  }
  if (outcome.missing == 0) outcome.text = WriteStudyOutputs(plan, results, folder);
  return outcome;
}

}  // namespace

JobResult JobRunner::Run(const StudyJob& job) {
  JobResult result = EmptyResult(plan_, job);
  result.status = "failed";
  try {
    return Solve(job);
  } catch (const std::exception& error) {
    result.reason = error.what();
  } catch (...) {
    result.reason = "an exception of unknown type";
  }
  return result;
}

JobResult JobRunner::Solve(const StudyJob& job) {
  const TestProblem& problem = plan_.problems[job.problem].problem;
  const Contender& contender = plan_.contenders[job.contender];
  const StudySolver& entry = plan_.solvers[contender.solver];
  if (made_ != job.problem) {
    fit_ = problem.make();
    made_ = job.problem;
  }
  const std::uint64_t seed = plan_.JobSeed(job);
  std::vector<double> start = fit_->StartVector();
  if (plan_.settings.random_starts) {
    const SearchBox box = MakeSearchBox(*fit_, std::string("fit"), "study.starts: random");
    Random random = Random::ForKey(seed, "start");
    start = box.FullVector(box.RandomPoint(&random).data());
  }
  const FitFrom fit(*fit_, start);
  JobResult result = EmptyResult(plan_, job);
  result.start_objective = fit.Objective(start);
  result.free_parameters = fit.NumFreeParameters();
  Budget budget = contender.budget;
  if (plan_.settings.stop_at_target && problem.best_objective) {
    budget.target_objective =
        TargetObjective(plan_.settings.scale, plan_.settings.target, *problem.best_objective,
                        result.start_objective, problem.resolution);
  }
  result.report =
      FindSolverType(entry.type).create(entry.options)->Solve(fit, budget, {.threads = 1, .seed = seed});
  if (result.report.termination == Termination::kFailed || !std::isfinite(result.report.objective)) {
    result.status = "failed";
    result.reason = result.report.message.empty() ? "the objective is not a number" : result.report.message;
  } else {
    for (const auto& [name, value] : fit.Metrics(result.report.x)) result.metrics.Set(name, value);
  }
  return result;
}

StudyOutcome RunStudy(const StudyPlan& plan, const fs::path& folder, const StudyRunOptions& options) {
  CheckMerge(options.merge, folder);
  PrepareFolder(plan, folder, options.overwrite);
  StudyLock lock(folder);
  RefreshConfig(plan, folder);
  RemoveLeftovers(folder);
  for (const fs::path& from : options.merge) Merge(plan, from, folder);
  const auto results = LoadResults(plan, folder, true);
  const auto part = static_cast<std::size_t>(plan.settings.part),
             parts = static_cast<std::size_t>(plan.settings.parts);
  std::vector<std::size_t> pending;
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (k / plan.contenders.size() % parts + 1 == part && !results[k]) pending.push_back(k);
  }
  RunJobs(plan, pending, folder, options, &lock);
  RemoveLeftovers(folder);  // of workers killed at the time limit
  return Conclude(plan, folder);
}

StudyOutcome RunStudy(const fs::path& config, const RunFlags& flags, const fs::path& out,
                      const StudyRunOptions& options) {
  ConfigFile file = ConfigFile::Load(config);
  if (!flags.set.empty()) file.Override(flags.set);
  const StudyPlan plan = ReadStudyPlan(file, flags);
  return RunStudy(plan, out.empty() ? fs::path("runs") / plan.name : out, options);
}

StudyOutcome ReportStudy(const fs::path& folder) {
  if (!fs::exists(folder / kPlanFile)) {
    throw ConfigError(folder.string() + ": is not the folder of a study (it has no plan.csv)");
  }
  const StudyLock lock(folder);
  StudyPlan plan = ReadStudyPlan(ConfigFile::Load(folder / "config.yaml"), {});
  AdoptKeys(ReadFileBytes(folder / kPlanFile), folder / kPlanFile, &plan);
  StudyOutcome outcome = Conclude(plan, folder);
  if (outcome.missing > 0) {
    throw InputError(folder.string() + ": " + std::to_string(outcome.missing) + " of " +
                     std::to_string(outcome.jobs) + " jobs have no result yet; go on with `frond study`");
  }
  return outcome;
}

std::size_t CheckStudy(const ConfigFile& config, const RunFlags& flags) {
  return ReadStudyPlan(config, flags).jobs.size();
}

}  // namespace frond
