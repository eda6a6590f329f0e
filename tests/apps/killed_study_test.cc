// SPDX-License-Identifier: BSD-3-Clause
// A study that is killed again and again gives what one that was left alone does, each result made once.
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

// 200 jobs of some 10 ms.
constexpr char kConfig[] = R"(name: killed
seed: 9
problems:
  rosenbrock: {set: functions, function: rosenbrock, dimension: 10}
  ackley: {set: functions, function: ackley, dimension: 10}
solvers:
  pso: {swarm_size: 20}
  cmaes: {type: pagmo.cmaes, population_size: 20}
budget: {evaluations: 20000}
study: {repetitions: 50, starts: random, stop_at_target: false}
)";

struct FileState {
  std::string bytes;
  ino_t inode = 0;
  std::int64_t written = 0;  // nanoseconds

  bool operator==(const FileState&) const = default;
};

std::map<std::string, FileState> WholeResults(const fs::path& run) {
  std::map<std::string, FileState> files;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(run / "jobs", absent)) {
    if (entry.path().extension() != ".json") continue;
    struct stat status {};
    if (::stat(entry.path().c_str(), &status) != 0) continue;
    files[entry.path().filename()] = {
        FileText(entry.path()), status.st_ino,
        std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + std::int64_t{status.st_mtim.tv_nsec}};
  }
  return files;
}

// Names of the results that plan.csv asks for, sorted.
std::vector<std::string> PlannedResults(const fs::path& run) {
  std::istringstream plan(FileText(run / "plan.csv"));
  std::string line;
  std::getline(plan, line);
  std::set<std::string> names;
  while (std::getline(plan, line)) names.insert(line.substr(0, line.find(',')) + ".json");
  return {names.begin(), names.end()};
}

// runs.csv without its last two columns, the times.
std::string RunsWithoutTimes(const fs::path& run) {
  std::istringstream lines(FileText(run / "runs.csv"));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    for (int k = 0; k < 2; ++k) line.resize(line.rfind(','));
    text += line + "\n";
  }
  return text;
}

// Whether a process has `text` in its command line; workers have that of the study that forked them.
bool AProcessHas(const std::string& text) {
  std::error_code gone;
  for (auto entry = fs::directory_iterator("/proc", gone); entry != fs::directory_iterator();
       entry.increment(gone)) {
    if (FileText(entry->path() / "cmdline").find(text) != std::string::npos) return true;
  }
  return false;
}

// Starts the study and kills it as soon as `ready`; whether the signal ended it.
bool KillWhen(const std::vector<std::string>& study, const fs::path& working,
              const std::function<bool()>& ready) {
  const pid_t child = StartFrond(study, working);
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (ready()) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

// For KillWhen: true once `milliseconds` have passed.
std::function<bool()> After(std::uint32_t milliseconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  return [=] { return std::chrono::steady_clock::now() > end; };
}

// For KillWhen: true once jobs/ has `count` results.
std::function<bool()> AtResults(const fs::path& run, std::size_t count) {
  return [=] { return fs::exists(run / "jobs") && NamesIn(run / "jobs").size() >= count; };
}

bool EndsWithin(std::chrono::milliseconds limit, const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (AProcessHas(text)) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

TEST(KilledStudy, TenTimes_GoesOnWithEveryResultMadeOnce) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  const std::string out = (folder / "run").string();
  const std::vector<std::string> study = {"study", "study.yaml", "--quiet", "--threads=2", "--out=" + out};
  std::mt19937 random(20240607);
  std::map<std::string, FileState> seen;  // as they were when first there
  int killed = 0, interrupted = 0;
  for (int kill = 0; kill < 10; ++kill) {
    // While it starts, or amid its jobs.
    const auto ready = kill % 3 == 0 ? After(static_cast<std::uint32_t>(random() % 100))
                                     : AtResults(out, seen.size() + 1 + random() % 20);
    killed += KillWhen(study, folder.path(), ready) ? 1 : 0;
    ASSERT_TRUE(EndsWithin(std::chrono::seconds(1), "--out=" + out)) << "workers outlive their study";
    const auto results = WholeResults(out);
    for (const auto& [name, state] : seen) EXPECT_TRUE(results.at(name) == state) << name;
    interrupted += !results.empty() && results.size() < 200 ? 1 : 0;
    seen.insert(results.begin(), results.end());
  }
  EXPECT_GE(killed, 8) << "the study is too short to be killed";
  EXPECT_GE(interrupted, 5) << "the study was hardly killed amid its jobs";

  const ProgramResult last = RunFrond(study, folder.path());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(last.err, "");
  const auto results = WholeResults(out);
  for (const auto& [name, state] : seen) EXPECT_TRUE(results.at(name) == state) << name << " was made again";
  EXPECT_EQ(results.size(), 200U);
  EXPECT_EQ(NamesIn(folder / "run/jobs"), PlannedResults(out)) << "nothing else is left in jobs/";

  ASSERT_EQ(
      RunFrond({"study", "study.yaml", "--quiet", "--threads=2", "--out=alone"}, folder.path()).exit_code, 0);
  EXPECT_EQ(RunsWithoutTimes(out), RunsWithoutTimes(folder / "alone"));
  EXPECT_EQ(NamesIn(out), NamesIn(folder / "alone")) << "and nothing else beside the results";
}

TEST(KilledStudy, ResumedAtOnce_WaitsForTheDyingOne) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  const std::vector<std::string> study = {"study", "study.yaml", "--quiet", "--threads=2", "--out=run"};
  for (int kill = 0; kill < 3; ++kill) {
    (void)KillWhen(study, folder.path(), AtResults(folder / "run", 20 * static_cast<std::size_t>(kill + 1)));
  }
  const ProgramResult last = RunFrond(study, folder.path());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(WholeResults(folder / "run").size(), 200U);
}

TEST(KilledStudy, WhoseWorkersAreKilled_HasThatAsTheirResult) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  // Every job takes longer than the limit of a tenth of a millisecond.
  const ProgramResult result =
      RunFrond({"study", "study.yaml", "--quiet", "--threads=2", "--out=run",
                "--set=study.repetitions=2; study.time_limit=1e-4; budget.evaluations=1e9"},
               folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "frond: warning: 8 of 8 jobs failed; see run/runs.csv\n");
  EXPECT_EQ(NamesIn(folder / "run/jobs"), PlannedResults(folder / "run"));
}

}  // namespace
}  // namespace frond
