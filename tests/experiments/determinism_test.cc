// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "io/metrics_json.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

// metrics.json without what two runs may differ in: times, memory, threads.
std::string Comparable(const std::filesystem::path& run) {
  auto json = nlohmann::ordered_json::parse(FileText(run / "metrics.json"));
  for (const char* key : {"seconds", "stages", "peak_rss_bytes", "threads"}) json.erase(key);
  json["solver"].erase("seconds");
  return json.dump();
}

TEST(Determinism, Threads_DoNotChangeAByte) {
  const TempFolder folder;
  WriteLeafFiles(folder, 10000, 10000);
  const std::string fit =
      "input: {cloud: scan.ply, truth: truth.ply}\n"
      "problem: {type: leaf, surface: {degree: [3, 3], control_points: [20, 20]}}\nsolver: {type: lm}\n"
      "output: {formats: [json, step, iges, ply]}\n";
  const auto one = Fit(folder, fit, "one", {.set = "", .seed = {}, .threads = 1});
  for (const int threads : {2, 3}) {
    const auto more = Fit(folder, fit, std::to_string(threads), {.set = "", .seed = {}, .threads = threads});
    for (const char* file : {"surface.json", "surface.ply", "deviation.ply", "outliers.csv"}) {
      EXPECT_TRUE(FileText(one / file) == FileText(more / file)) << file << ", " << threads << " threads";
    }
    EXPECT_EQ(Comparable(one), Comparable(more));
  }
}

TEST(Determinism, Threads_DoNotChangeASwarm) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const std::string fit =
      "input: {cloud: scan.ply}\nseed: 9\nproblem: {type: leaf, method: paper, paper: {weights: free}}\n"
      "solver: {type: pso, swarm_size: 5, iterations: 10}\noutput: {formats: [json]}\n";
  const auto one = Fit(folder, fit, "one", {.set = "", .seed = {}, .threads = 1});
  const auto two = Fit(folder, fit, "two", {.set = "", .seed = {}, .threads = 2});
  EXPECT_EQ(FileText(one / "surface.json"), FileText(two / "surface.json"));
  EXPECT_EQ(Comparable(one), Comparable(two));
  const auto other = Fit(folder, fit, "other", {.set = "", .seed = 10, .threads = 1});
  EXPECT_NE(FileText(one / "surface.json"), FileText(other / "surface.json"));
}

TEST(Determinism, ResolvedConfig_RepeatsTheRun) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const std::string cases[] = {
      "input: {cloud: scan.ply, truth: truth.ply}\nseed: 4\nproblem: {type: leaf, surface: {control_points: "
      "8}}\n",
      "input: {cloud: scan.ply}\nproblem: {type: leaf, surface: {control_points: 6}}\n",  // conforming
      "input: {cloud: scan.ply}\nproblem: {type: leaf, surface: {control_points: 9}, fit: {start: paper}}\n",
      "input: {synthetic_leaf: 3, points: 2500}\nproblem: {type: leaf, method: paper, paper: {weights: "
      "free}}\n"
      "solver: {type: pso_lm, pso: {swarm_size: 4, iterations: 3}, lm: {max_iterations: 5}}\n",
      "input: {cloud: scan.ply}\nproblem: {type: surface, surface: {control_points: [9, 7]}, fit: {loss: "
      "huber}}\n"
      "solver: {type: dogleg}\n",
  };
  int k = 0;
  for (const std::string& fit : cases) {
    const std::string name = "run" + std::to_string(k++);
    const auto first = Fit(folder, fit + "output: {formats: [json]}\n", name);
    const auto second = FitConfig(first / "config.yaml", {}, folder / (name + "_again"), false, false);
    EXPECT_EQ(FileText(first / "surface.json"), FileText(second / "surface.json"));
    EXPECT_EQ(FileText(first / "config.yaml"), FileText(second / "config.yaml"));
    EXPECT_EQ(Comparable(first), Comparable(second));
  }
}

}  // namespace
}  // namespace frond
