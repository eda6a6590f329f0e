// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

// Long enough in the fit (row by row) and in the writing (STEP, IGES) to be caught in both.
constexpr char kConfig[] = R"(name: killed
input: {synthetic_leaf: 1, points: 4000}
problem: {type: leaf, surface: {control_points: [24, 24]}, fit: {derivatives: DERIVATIVES}}
output: {formats: [step, iges, json]}
)";

std::filesystem::path WriteConfig(const TempFolder& folder, const std::string& derivatives) {
  std::string text = kConfig;
  text.replace(text.find("DERIVATIVES"), 11, derivatives);
  return folder.Write("fit.yaml", text);
}

// Starts the fit, kills it as soon as `ready`, and returns whether the signal ended it: it may be done first.
bool KillFitWhen(const TempFolder& folder, const std::function<bool()>& ready) {
  const pid_t child = StartFrond({"fit", "fit.yaml", "--out=out/run"}, folder.path());
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

// Whether the run has begun to write its results, into the hidden folder beside the target.
bool IsWriting(const TempFolder& folder) {
  for (const std::string& name : NamesIn(folder / "out")) {
    if (name.starts_with(".run.partial-") && std::filesystem::exists(folder / ("out/" + name + "/trace.csv")))
      return true;
  }
  return false;
}

// A run that was killed has left all of its target (killed after the rename) or nothing; one that ended
// before the signal came has left all.
void ExpectWholeOrAbsent(const TempFolder& folder, bool killed) {
  const std::filesystem::path run = folder / "out/run";
  if (killed && !std::filesystem::exists(run)) return;
  EXPECT_EQ(NamesIn(run), (std::vector<std::string>{"config.yaml", "deviation.ply", "log.txt", "metrics.json",
                                                    "outliers.csv", "surface.igs", "surface.json",
                                                    "surface.step", "trace.csv"}));
}

TEST(KilledRun, AtAnyTime_LeavesAWholeTargetOrNone) {
  for (const int milliseconds : {5, 50, 300}) {
    const TempFolder folder;
    WriteConfig(folder, "autodiff");
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    const bool killed = KillFitWhen(folder, [&] { return std::chrono::steady_clock::now() > end; });
    ExpectWholeOrAbsent(folder, killed);
  }
}

TEST(KilledRun, InTheWriting_LeavesAWholeTargetOrNoneAndTheNextRunWorks) {
  constexpr int kAttempts = 3;  // at meeting it in the writing
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const TempFolder folder;
    WriteConfig(folder, "structured");
    std::filesystem::create_directory(folder / "out");
    const bool killed = KillFitWhen(folder, [&] { return IsWriting(folder); });
    ExpectWholeOrAbsent(folder, killed);
    EXPECT_EQ(RunFrond({"fit", "fit.yaml", "--out=out/run", "--overwrite"}, folder.path()).exit_code, 0);
    ExpectWholeOrAbsent(folder, false);
    if (killed) break;
  }
}

}  // namespace
}  // namespace frond
