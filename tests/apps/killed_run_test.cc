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

// Starts the fit, kills it as soon as `ready`, and returns whether the signal ended it.
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

// The hidden folder that a run is written into.
std::filesystem::path PartialFolder(const TempFolder& folder) {
  if (!std::filesystem::exists(folder / "out")) return {};
  for (const std::string& name : NamesIn(folder / "out")) {
    if (name.starts_with(".run.partial-")) return folder / ("out/" + name);
  }
  return {};
}

TEST(KilledRun, InTheFit_LeavesNoTarget) {
  const TempFolder folder;
  WriteConfig(folder, "autodiff");
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(KillFitWhen(
      folder, [&] { return std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(300); }));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/run"));
}

TEST(KilledRun, InTheWriting_LeavesNoTargetAndTheNextRunWorks) {
  const TempFolder folder;
  WriteConfig(folder, "structured");
  ASSERT_TRUE(KillFitWhen(folder, [&] {
    const std::filesystem::path partial = PartialFolder(folder);
    return !partial.empty() && std::filesystem::exists(partial / "trace.csv");
  }));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/run"));
  EXPECT_EQ(RunFrond({"fit", "fit.yaml", "--out=out/run"}, folder.path()).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/run/metrics.json"));
}

}  // namespace
}  // namespace frond
