// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "base/errors.h"
#include "experiments/study/study.h"
#include "small_study.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

using Row = std::map<std::string, std::string>;

RunFlags Set(const std::string& set) { return {.set = set, .seed = {}, .threads = 1}; }

StudyPlan PlanWith(const std::string& set) {
  ConfigFile config = ConfigFile::Parse(kSmallStudy, "study.yaml");
  config.Override(set);
  return ReadStudyPlan(config, {});
}

// Runs the small study in `folder` by `workers` processes.
StudyOutcome RunSmall(const std::filesystem::path& folder, int workers = 2) {
  return RunStudy(PlanOf(kSmallStudy), folder, {.workers = workers});
}

TEST(StudyRun, WithAnyNumberOfWorkers_GivesTheSameRuns) {
  const TempFolder folder;
  for (int workers = 1; workers <= 3; ++workers) {
    const StudyOutcome outcome = RunSmall(folder / std::to_string(workers), workers);
    EXPECT_EQ(outcome.jobs, 24U);
    EXPECT_EQ(outcome.missing, 0U);
    EXPECT_EQ(outcome.failed, 0U);
    EXPECT_FALSE(outcome.text.empty());
    EXPECT_EQ(RunsWithoutTimes(folder / std::to_string(workers)), RunsWithoutTimes(folder / "1"));
  }
  EXPECT_EQ(CsvRows(folder / "1/runs.csv").size(), 24U);
}

TEST(StudyRun, RunsInTheOrderOfThePlan_WithItsKeys) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const StudyPlan plan = PlanOf(kSmallStudy);
  const std::vector<Row> rows = CsvRows(folder / "run/runs.csv");
  ASSERT_EQ(rows.size(), plan.jobs.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].at("key"), plan.jobs[k].key);
    EXPECT_EQ(rows[k].at("problem"), plan.problems[plan.jobs[k].problem].name);
    EXPECT_EQ(rows[k].at("contender"), plan.contenders[plan.jobs[k].contender].name);
    EXPECT_EQ(rows[k].at("repetition"), std::to_string(plan.jobs[k].repetition));
  }
}

TEST(StudyRun, ResumedInTheSameFolder_MakesTheMissingResultsAlone) {
  const TempFolder folder;
  RunSmall(folder / "whole");
  const StudyOutcome part = RunStudy(PlanWith("study.part=[2, 3]"), folder / "run", {});
  EXPECT_EQ(part.missing, 16U);
  EXPECT_EQ(part.text, "");
  EXPECT_FALSE(std::filesystem::exists(folder / "run/runs.csv"));
  const auto before = ResultFiles(folder / "run");
  ASSERT_EQ(before.size(), 8U);
  EXPECT_EQ(RunSmall(folder / "run").missing, 0U);
  const auto after = ResultFiles(folder / "run");
  EXPECT_EQ(after.size(), 24U);
  for (const auto& [name, state] : before) EXPECT_TRUE(after.at(name) == state) << name;
  EXPECT_EQ(RunsWithoutTimes(folder / "run"), RunsWithoutTimes(folder / "whole"));
}

TEST(StudyRun, ResultThatIsGone_IsMadeAgainAlone) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const std::string runs = RunsWithoutTimes(folder / "run");
  const auto before = ResultFiles(folder / "run");
  const std::string gone = PlanOf(kSmallStudy).jobs[7].key + ".json";
  std::filesystem::remove(folder / "run/jobs" / gone);
  RunSmall(folder / "run");
  const auto after = ResultFiles(folder / "run");
  for (const auto& [name, state] : before) EXPECT_EQ(after.at(name) == state, name != gone) << name;
  EXPECT_EQ(RunsWithoutTimes(folder / "run"), runs);
}

TEST(StudyRun, PartsOfTwoFolders_MergeToTheWhole) {
  const TempFolder folder;
  RunSmall(folder / "whole");
  EXPECT_EQ(RunStudy(PlanWith("study.part=[1, 2]"), folder / "a", {}).missing, 12U);
  EXPECT_EQ(RunStudy(PlanWith("study.part=[2, 2]"), folder / "b", {}).missing, 12U);
  const auto a = ResultFiles(folder / "a"), b = ResultFiles(folder / "b");
  const StudyOutcome merged =
      RunStudy(PlanOf(kSmallStudy), folder / "merged", {.merge = {folder / "a", folder / "b"}});
  EXPECT_EQ(merged.missing, 0U);
  auto files = ResultFiles(folder / "merged");
  EXPECT_EQ(files.size(), 24U);
  for (const auto& part : {a, b}) {
    EXPECT_EQ(part.size(), 12U);
    for (const auto& [name, state] : part) EXPECT_EQ(files.at(name).bytes, state.bytes);
  }
  EXPECT_EQ(RunsWithoutTimes(folder / "merged"), RunsWithoutTimes(folder / "whole"));
  // One part taken over into the folder of the other.
  EXPECT_EQ(RunStudy(PlanWith("study.part=[1, 2]"), folder / "a", {.merge = {folder / "b"}}).missing, 0U);
  EXPECT_EQ(RunsWithoutTimes(folder / "a"), RunsWithoutTimes(folder / "whole"));
}

TEST(StudyRun, MergeOfAnotherStudyOrNone_IsRefused) {
  const TempFolder folder;
  RunStudy(PlanWith("seed=6; study.part=[1, 24]"), folder / "other", {});
  const auto merge = [&](const std::string& from) {
    return MessageOf<ConfigError>(
        [&] { RunStudy(PlanOf(kSmallStudy), folder / "run", {.merge = {folder / from}}); });
  };
  EXPECT_TRUE(Holds(merge("other"), "other: has no results of this study"));
  EXPECT_TRUE(Holds(merge("nowhere"), "nowhere: is not the folder of a study"));
}

TEST(StudyRun, Twice_RunsNothingAndReportsTheSameBytes) {
  const TempFolder folder;
  const std::string text = RunSmall(folder / "run").text;
  const auto before = ResultFiles(folder / "run");
  std::map<std::string, std::string> reports;
  const char* const files[] = {"report.html", "summary.md", "summary.csv", "runs.csv",
                               "traces/sphere/pso.csv"};
  for (const char* file : files) reports[file] = FileText(folder / "run" / file);
  EXPECT_EQ(RunSmall(folder / "run").text, text);
  EXPECT_EQ(ReportStudy(folder / "run").text, text);
  EXPECT_TRUE(ResultFiles(folder / "run") == before);
  for (const char* file : files) {
    EXPECT_FALSE(reports[file].empty()) << file;
    EXPECT_EQ(FileText(folder / "run" / file), reports[file]) << file;
  }
}

TEST(StudyRun, Repetitions_ArePairedAcrossSolversAndDifferFromEachOther) {
  const TempFolder folder;
  RunSmall(folder / "run");
  std::map<std::string, std::set<std::string>> starts, seeds;
  for (const Row& row : CsvRows(folder / "run/runs.csv")) {
    starts[row.at("problem") + row.at("repetition")].insert(row.at("start_objective"));
    seeds[row.at("problem") + row.at("repetition")].insert(row.at("seed"));
  }
  ASSERT_EQ(starts.size(), 6U);
  std::set<std::string> all, all_seeds;
  for (const auto& [repetition, values] : starts) {
    EXPECT_EQ(values.size(), 1U) << repetition;
    EXPECT_EQ(seeds[repetition].size(), 1U) << repetition;
    all.insert(*values.begin());
    all_seeds.insert(*seeds[repetition].begin());
  }
  EXPECT_EQ(all.size(), 6U);
  EXPECT_EQ(all_seeds.size(), 6U);

  RunStudy(PlanWith("seed=6"), folder / "other", {.workers = 2});
  for (const Row& row : CsvRows(folder / "other/runs.csv")) {
    EXPECT_EQ(all.count(row.at("start_objective")), 0U) << row.at("problem");
  }
}

TEST(StudyRun, GivenStarts_AreTheSameForAllRepetitions) {
  const TempFolder folder;
  RunStudy(PlanWith("study.starts=given"), folder / "run", {.workers = 2});
  std::map<std::string, std::set<std::string>> starts;
  for (const Row& row : CsvRows(folder / "run/runs.csv")) {
    starts[row.at("problem")].insert(row.at("start_objective"));
  }
  EXPECT_EQ(starts["rosenbrock"].size(), 1U);
  EXPECT_EQ(starts["sphere"].size(), 1U);
}

TEST(StudyRun, Traces_EndAtTheObjectiveAndWithinTheBudget) {
  const TempFolder folder;
  RunStudy(PlanWith("study.stop_at_target=false"), folder / "run", {.workers = 2});
  for (const Row& row : CsvRows(folder / "run/runs.csv")) {
    const std::string name = "traces/" + row.at("problem") + "/" + row.at("contender") + ".csv";
    double last = -1, before = 1e300;
    std::int64_t evaluations = 0;
    for (const Row& point : CsvRows(folder / "run" / name)) {
      if (point.at("repetition") != row.at("repetition")) continue;
      last = std::stod(point.at("best_objective"));
      EXPECT_LE(last, before) << name;
      EXPECT_GE(std::stoll(point.at("evaluations")), evaluations) << name;
      before = last;
      evaluations = std::stoll(point.at("evaluations"));
    }
    EXPECT_EQ(last, std::stod(row.at("objective"))) << name;
    EXPECT_LE(evaluations, std::stoll(row.at("evaluations"))) << name;
    EXPECT_LE(std::stoll(row.at("evaluations")), 2000 + 10) << name;
  }
}

TEST(StudyRun, RunsThatSucceed_StopAtTheTarget) {
  const TempFolder folder;
  RunStudy(PlanWith("study.target=1e-2"), folder / "run", {.workers = 2});
  int successes = 0;
  for (const Row& row : CsvRows(folder / "run/runs.csv")) {
    // Moré and Wild with f_L = 0: f ≤ τ f₀.
    const bool reached = std::stod(row.at("objective")) <= 1e-2 * std::stod(row.at("start_objective"));
    EXPECT_EQ(row.at("success"), reached ? "1" : "0");
    if (!reached) continue;
    ++successes;
    EXPECT_EQ(row.at("termination"), "target");
    EXPECT_LE(std::stoll(row.at("target_evaluations")), std::stoll(row.at("evaluations")));
    EXPECT_GE(std::stoll(row.at("target_evaluations")), std::stoll(row.at("evaluations")) - 10);
  }
  EXPECT_GT(successes, 12);
}

TEST(StudyRun, ListOfBudgets_MakesAContenderOfEach) {
  const TempFolder folder;
  RunStudy(PlanWith("budget.evaluations=[200, 2000]; study.stop_at_target=false"), folder / "run",
           {.workers = 2});
  std::map<std::string, std::int64_t> most;
  for (const Row& row : CsvRows(folder / "run/runs.csv")) {
    most[row.at("contender")] =
        std::max<std::int64_t>(most[row.at("contender")], std::stoll(row.at("evaluations")));
  }
  EXPECT_EQ(most.size(), 8U);
  EXPECT_GE(most.at("pso@200"), 200);
  EXPECT_LE(most.at("pso@200"), 210);
  EXPECT_GE(most.at("pso@2000"), 2000);
  EXPECT_LE(most.at("pso@2000"), 2010);
  EXPECT_TRUE(std::filesystem::exists(folder / "run/traces/sphere/pso@200.csv"));
}

TEST(StudyRun, ConfigFile_RunsByItsNameOrWhereAsked) {
  const TempFolder folder;
  const auto config = folder.Write("study.yaml", kSmallStudy);
  const StudyOutcome outcome = RunStudy(config, Set("study.repetitions=1"), folder / "there", {.workers = 2});
  EXPECT_EQ(outcome.jobs, 8U);
  EXPECT_EQ(outcome.folder, folder / "there");
  EXPECT_EQ(CheckStudy(ConfigFile::Load(config), {}), 24U);
}

}  // namespace
}  // namespace frond
