// SPDX-License-Identifier: BSD-3-Clause
// Jobs that fail, and folders that cannot be gone on with.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "base/errors.h"
#include "experiments/study/study.h"
#include "experiments/study/study_lock.h"
#include "small_study.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

using Row = std::map<std::string, std::string>;

constexpr char kProblems[] = R"(name: failures
problems:
  first: {set: functions, function: sphere, dimension: 2}
  no_fit: {set: functions, function: sphere, dimension: 2}
  throws: {set: functions, function: sphere, dimension: 2}
  throws_late: {set: functions, function: sphere, dimension: 2}
  hangs: {set: functions, function: sphere, dimension: 2}
  segfaults: {set: functions, function: sphere, dimension: 2}
  aborts: {set: functions, function: sphere, dimension: 2}
  exits: {set: functions, function: sphere, dimension: 2}
  never_a_number: {set: functions, function: sphere, dimension: 2}
  odd: {set: functions, function: sphere, dimension: 2}
  last: {set: functions, function: sphere, dimension: 2}
solvers:
  lm: {}
  pso: {swarm_size: 10}
budget: {evaluations: 500}
study: {repetitions: 2, starts: random, time_limit: 1}
)";

// As kProblems, each problem as bad as its name says.
StudyPlan BadPlan() {
  StudyPlan plan = PlanOf(kProblems);
  std::map<std::string, std::function<double(const double*)>> residuals;
  residuals["throws"] = [](const double*) -> double { throw FitError("the leaf, \"withered\", fell"); };
  residuals["throws_late"] = [calls = 0](const double* x) mutable -> double {
    if (++calls > 4) throw std::logic_error("too often");
    return x[0] + x[1];
  };
  residuals["hangs"] = [](const double*) -> double {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  residuals["segfaults"] = [](const double*) -> double {
    (void)::signal(SIGSEGV, SIG_DFL);  // sanitizers have a handler of their own
    return ::raise(SIGSEGV);
  };
  residuals["aborts"] = [](const double*) -> double { std::abort(); };
  residuals["exits"] = [](const double*) -> double { ::_exit(7); };
  residuals["never_a_number"] = [](const double*) { return std::numeric_limits<double>::quiet_NaN(); };
  residuals["odd"] = [](const double*) -> double { throw 3; };
  for (StudyProblem& problem : plan.problems) {
    const auto residual = residuals.find(problem.name);
    if (residual != residuals.end()) {
      problem.problem.make = [function = residual->second] { return FitOf(function); };
    }
    if (problem.name == "no_fit") {
      problem.problem.make = []() -> std::shared_ptr<const FitProblem> { throw InputError("no such scan"); };
    }
  }
  return plan;
}

TEST(StudyFailures, OfEveryKind_AreResultsAndTheRestGoesOn) {
  const TempFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  const StudyOutcome outcome = RunStudy(BadPlan(), folder / "run", {.workers = 2});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 20);  // four jobs of 1 s hang
  EXPECT_EQ(outcome.jobs, 44U);
  EXPECT_EQ(outcome.missing, 0U);
  EXPECT_EQ(outcome.failed, 36U);
  EXPECT_FALSE(outcome.text.empty());
  struct Expected {
    const char *status, *reason;
  };
  const std::map<std::string, Expected> expected = {
      {"first", {"ok", ""}},
      {"last", {"ok", ""}},
      {"no_fit", {"failed", "no such scan"}},
      {"throws", {"failed", "the leaf, \"withered\", fell"}},
      {"throws_late", {"failed", "too often"}},
      {"hangs", {"timeout", "no result within the time limit of 1 s"}},
      {"segfaults", {"crashed", "the process that ran it ended with signal 11 (Segmentation fault)"}},
      {"aborts", {"crashed", "the process that ran it ended with signal 6 (Aborted)"}},
      {"exits", {"crashed", "the process that ran it ended with exit code 7"}},
      {"odd", {"failed", "an exception of unknown type"}},
  };
  const std::vector<Row> rows = CsvRows(folder / "run/runs.csv");
  ASSERT_EQ(rows.size(), 44U);
  for (const Row& row : rows) {
    if (row.at("problem") == "never_a_number") {
      EXPECT_EQ(row.at("status"), "failed");
      EXPECT_NE(row.at("reason"), "");
      EXPECT_EQ(row.at("success"), "0");
      continue;
    }
    const Expected& want = expected.at(row.at("problem"));
    EXPECT_EQ(row.at("status"), want.status) << row.at("problem");
    EXPECT_EQ(row.at("reason"), want.reason) << row.at("problem");
  }
  // Failures are results too: nothing is run again, and the report can be made again from them.
  const auto files = ResultFiles(folder / "run");
  EXPECT_EQ(files.size(), 44U);
  EXPECT_EQ(RunStudy(BadPlan(), folder / "run", {}).text, outcome.text);
  EXPECT_TRUE(ResultFiles(folder / "run") == files);
}

// Runs the small study with `set` in the folder.
void RunSmall(const std::filesystem::path& folder, const std::string& set = "", bool overwrite = false) {
  ConfigFile config = ConfigFile::Parse(kSmallStudy, "study.yaml");
  if (!set.empty()) config.Override(set);
  RunStudy(ReadStudyPlan(config, {}), folder, {.workers = 2, .overwrite = overwrite});
}

TEST(StudyFolder, OfAnotherPlan_IsKeptUnlessOverwritten) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const auto before = ResultFiles(folder / "run");
  for (const char* other :
       {"seed=6", "study.repetitions=2", "solvers.pso.swarm_size=11", "study.target=1e-3"}) {
    const std::string message = MessageOf<ConfigError>([&] { RunSmall(folder / "run", other); });
    EXPECT_TRUE(Holds(message, (folder / "run").string() + ": holds another study"));
    EXPECT_TRUE(Holds(message, "--overwrite"));
  }
  EXPECT_TRUE(ResultFiles(folder / "run") == before);
  RunSmall(folder / "run", "study.repetitions=1", true);
  EXPECT_EQ(ResultFiles(folder / "run").size(), 8U);
}

TEST(StudyFolder, Overwritten_BeginsAnewEvenWithTheSamePlan) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const auto before = ResultFiles(folder / "run");
  RunSmall(folder / "run", "", true);
  const auto after = ResultFiles(folder / "run");
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [name, state] : after) EXPECT_NE(state.written, before.at(name).written) << name;
}

TEST(StudyFolder, ThatIsNoStudy_IsNeverTouched) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "mine");
  folder.Write("mine/thesis.txt", "years of work");
  for (const bool overwrite : {false, true}) {
    EXPECT_THROW(RunSmall(folder / "mine", "", overwrite), ConfigError);
    EXPECT_EQ(FileText(folder / "mine/thesis.txt"), "years of work");
  }
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { ReportStudy(folder / "mine"); }), "no plan.csv"));
}

TEST(StudyFolder, WithATruncatedResult_NamesItAndMakesItAgain) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const std::string runs = RunsWithoutTimes(folder / "run");
  const auto before = ResultFiles(folder / "run");
  const std::string name = PlanOf(kSmallStudy).jobs[3].key + ".json";
  for (const std::size_t size : {std::size_t{0}, before.at(name).bytes.size() / 2}) {
    folder.Write("run/jobs/" + name, before.at(name).bytes.substr(0, size));
    const std::string refused = MessageOf<InputError>([&] { ReportStudy(folder / "run"); });
    EXPECT_TRUE(Holds(refused, name + ": is not a whole result"));
    ::testing::internal::CaptureStderr();
    RunSmall(folder / "run");
    const std::string warning = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(warning, "frond: warning: " + (folder / "run/jobs").string() + "/" + name +
                           ": is not a whole result; the job is run again\n");
    const auto after = ResultFiles(folder / "run");
    for (const auto& [other, state] : before) {
      EXPECT_EQ(after.at(other) == state, other != name) << other;
    }
    EXPECT_EQ(RunsWithoutTimes(folder / "run"), runs);
  }
}

TEST(StudyFolder, LeftoversOfKilledWorkers_AreRemovedWhenItGoesOn) {
  const TempFolder folder;
  RunSmall(folder / "run");
  const auto before = ResultFiles(folder / "run");
  const std::string key = PlanOf(kSmallStudy).jobs[3].key;
  folder.Write("run/jobs/" + key + ".json.partial-4711", "{\"schema\": \"fr");
  folder.Write("run/jobs/notes.txt", "mine");
  RunSmall(folder / "run");
  auto after = ResultFiles(folder / "run");
  EXPECT_EQ(after.erase("notes.txt"), 1U);
  EXPECT_EQ(after.size(), before.size());
  EXPECT_TRUE(after == before);
}

TEST(StudyFolder, InUseByAnotherProcess_IsRefusedUntilThatEnds) {
  const TempFolder folder;
  RunSmall(folder / "run", "study.part=[1, 24]");
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const StudyLock lock(folder / "run");
    (void)!::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const std::string in_use = "another process is running this study";
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { RunSmall(folder / "run"); }), in_use));
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { RunSmall(folder / "run", "seed=6", true); }), in_use));
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { ReportStudy(folder / "run"); }), in_use));
  EXPECT_EQ(ResultFiles(folder / "run").size(), 4U);  // a repetition, by all contenders
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  RunSmall(folder / "run");
  EXPECT_EQ(ResultFiles(folder / "run").size(), 24U);
}

TEST(StudyFolder, WithJobsMissing_HasNoReport) {
  const TempFolder folder;
  RunSmall(folder / "run", "study.part=[1, 2]");
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReportStudy(folder / "run"); }),
                    "12 of 24 jobs have no result yet; go on with `frond study`"));
}

}  // namespace
}  // namespace frond
