// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_outputs.h"

#include <algorithm>
#include <functional>
#include <system_error>

#include "experiments/study/study_analysis.h"
#include "experiments/study/study_report.h"
#include "experiments/study/study_summary.h"
#include "experiments/study/study_tables.h"
#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

// Lets `write` make PATH.partial, then renames it.
void Replace(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  fs::path partial = path;
  partial += ".partial";
  std::error_code error;
  fs::remove_all(partial, error);
  write(partial);
  if (fs::is_directory(path, error)) fs::remove_all(path, error);  // rename replaces files, not folders
  fs::rename(partial, path, error);
  if (error) FailFile(path, "cannot be written: " + error.message());
}

// Names of metrics that any result has, in the order of the first that has them.
std::vector<std::string> MetricNames(const std::vector<JobResult>& results) {
  std::vector<std::string> names;
  for (const JobResult& result : results) {
    for (const auto& [name, value] : result.metrics.entries()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

void WriteRuns(const StudyPlan& plan, const std::vector<JobResult>& results, const StudyAnalysis& analysis,
               const fs::path& path) {
  const std::vector<std::string> metrics = MetricNames(results);
  std::vector<std::string> columns = {"problem",
                                      "contender",
                                      "solver",
                                      "repetition",
                                      "seed",
                                      "status",
                                      "reason",
                                      "termination",
                                      "objective",
                                      "start_objective",
                                      "gap",
                                      "success",
                                      "target_evaluations",
                                      "evaluations",
                                      "residual_evaluations",
                                      "jacobian_evaluations",
                                      "iterations"};
  for (const std::string& name : metrics) columns.push_back("metrics." + name);
  columns.insert(columns.end(), {"key", "seconds", "target_seconds"});
  std::vector<std::vector<MetricValue>> rows;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const JobResult& result = results[k];
    const SolverReport& report = result.report;
    const RunRow& run = analysis.runs[k];
    const StudyJob& job = plan.jobs[k];
    std::vector<MetricValue> row = {result.problem,
                                    result.contender,
                                    plan.solvers[plan.contenders[job.contender].solver].type,
                                    std::int64_t{result.repetition},
                                    std::to_string(plan.JobSeed(job)),
                                    result.status,
                                    result.reason,
                                    std::string(TerminationName(report.termination)),
                                    report.objective,
                                    result.start_objective,
                                    run.gap,
                                    std::int64_t{run.success ? 1 : 0},
                                    run.run_length,
                                    report.evaluations,
                                    report.residual_evaluations,
                                    report.jacobian_evaluations,
                                    std::int64_t{report.iterations}};
    for (const std::string& name : metrics) row.emplace_back(result.metrics.Number(name));
    row.insert(row.end(), {job.key, report.seconds, run.run_seconds});
    rows.push_back(std::move(row));
  }
  Replace(path, [&](const fs::path& partial) { WriteCsv(partial, columns, rows); });
}

// A file a problem and contender: PROBLEM/CONTENDER.csv, all repetitions.
void WriteTraces(const StudyPlan& plan, const std::vector<JobResult>& results, const fs::path& path) {
  Replace(path, [&](const fs::path& partial) {
    std::vector<std::string> texts(plan.problems.size() * plan.contenders.size(),
                                   "repetition,evaluations,seconds,best_objective\n");
    for (std::size_t k = 0; k < results.size(); ++k) {
      const StudyJob& job = plan.jobs[k];
      std::string& text = texts[job.problem * plan.contenders.size() + job.contender];
      for (const TracePoint& point : results[k].report.trace) {
        text += std::to_string(job.repetition) + "," + std::to_string(point.evaluations) + "," +
                FormatNumber(point.seconds) + "," + FormatNumber(point.best_objective) + "\n";
      }
    }
    for (std::size_t p = 0; p < plan.problems.size(); ++p) {
      fs::create_directories(partial / plan.problems[p].name);
      for (std::size_t c = 0; c < plan.contenders.size(); ++c) {
        WriteFileBytes(partial / plan.problems[p].name / (plan.contenders[c].name + ".csv"),
                       texts[p * plan.contenders.size() + c]);
      }
    }
  });
}

}  // namespace

std::string WriteStudyOutputs(const StudyPlan& plan, const std::vector<JobResult>& results,
                              const fs::path& folder) {
  const StudyAnalysis analysis = AnalyseStudy(plan, results);
  WriteRuns(plan, results, analysis, folder / "runs.csv");
  WriteTraces(plan, results, folder / "traces");
  const auto write = [&](const char* name, const std::string& text) {
    Replace(folder / name, [&](const fs::path& partial) { WriteFileBytes(partial, text); });
  };
  Replace(folder / "summary.csv", [&](const fs::path& partial) {
    const CsvTable table = StudyCsv(analysis);
    WriteCsv(partial, table.columns, table.rows);
  });
  write("summary.md", StudyMarkdown(plan, analysis));
  write("report.html", StudyReportHtml(plan, analysis));
  return TerminalReport(plan, analysis);
}

}  // namespace frond
