// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep.h"

#include <map>
#include <sstream>

#include "base/errors.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

// Rows by column name; the values hold no commas here.
std::vector<std::map<std::string, std::string>> ReadCsv(const std::filesystem::path& path) {
  std::istringstream file(FileText(path));
  std::vector<std::string> columns;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    if (columns.empty()) {
      columns = values;
      continue;
    }
    rows.emplace_back();
    for (std::size_t k = 0; k < values.size(); ++k) rows.back()[columns[k]] = values[k];
  }
  return rows;
}

const std::string kSweep =
    "name: sweep\ninput: {synthetic_leaf: 1, points: 500}\n"
    "problem: {type: leaf, method: paper, point_set: {slices: 10, selected: 8}, "
    "surface: {degree: [2, 2], control_points: [3, 7]}}\n"
    "sweep:\n  input.points: [500, 1000]\n  seed: [1, 2, 3]\n"
    "output: {plot: {x: input.points, y: [test_rmse, test_max]}}\n";

TEST(Sweep, WritesARowARunAndTheirMeans) {
  const TempFolder folder;
  const auto run = Fit(folder, kSweep, "run", {.set = "", .seed = {}, .threads = 2});
  const auto runs = ReadCsv(run / "runs.csv"), summary = ReadCsv(run / "summary.csv");
  ASSERT_EQ(runs.size(), 6U);
  EXPECT_EQ(runs[0].at("input.points"), "500");
  EXPECT_EQ(runs[1].at("seed"), "2");
  EXPECT_EQ(runs[3].at("input.points"), "1000");
  ASSERT_EQ(summary.size(), 2U);
  for (const int k : {0, 1}) {
    double sum = 0;
    for (const int i : {0, 1, 2}) {
      EXPECT_EQ(runs[3 * k + i].at("status"), "ok");
      sum += std::stod(runs[3 * k + i].at("test_rmse"));
    }
    EXPECT_EQ(summary[k].at("runs"), "3");
    EXPECT_EQ(summary[k].at("failed"), "0");
    EXPECT_NEAR(std::stod(summary[k].at("test_rmse")), sum / 3, 1e-12);
  }
  const std::string plot = FileText(run / "plot.svg");
  EXPECT_TRUE(plot.starts_with("<svg") || plot.starts_with("<?xml"));
  EXPECT_TRUE(Holds(plot, "test_max"));
}

TEST(Sweep, Threads_DoNotChangeATable) {
  const TempFolder folder;
  const auto one = Fit(folder, kSweep, "one", {.set = "", .seed = {}, .threads = 1});
  const auto two = Fit(folder, kSweep, "two", {.set = "", .seed = {}, .threads = 2});
  for (const char* file : {"runs.csv", "summary.csv", "plot.svg", "config.yaml"}) {
    EXPECT_EQ(FileText(one / file), FileText(two / file)) << file;
  }
}

TEST(Sweep, ResolvedConfig_RepeatsTheTablesAndThePlot) {
  const TempFolder folder;
  const auto first = Fit(folder, kSweep, "first");
  const auto second = FitConfig(first / "config.yaml", {}, folder / "second", false, false);
  for (const char* file : {"runs.csv", "summary.csv", "plot.svg", "config.yaml"}) {
    EXPECT_EQ(FileText(first / file), FileText(second / file)) << file;
  }
}

TEST(Sweep, Config_RepeatsSweepsOfSolverAndMethodWithoutTheFirstRunsDefaults) {
  const TempFolder folder;
  const auto first = Fit(
      folder,
      "seed: 5\ninput: {synthetic_leaf: 1, points: 500}\n"
      "problem: {type: leaf, point_set: {slices: 10, selected: 8}}\n"
      "sweep: {solver.type: [lm, pso], problem.method: [paper]}\n",
      "first", {.set = "problem.surface={degree: [2, 2], control_points: [3, 7]}", .seed = {}, .threads = 1});
  const std::string config = FileText(first / "config.yaml");
  EXPECT_TRUE(Holds(config, "name: fit\nseed: 5\n"));
  EXPECT_TRUE(Holds(config, "control_points: [3, 7]"));
  EXPECT_TRUE(Holds(config, "solver.type: [lm, pso]"));
  EXPECT_FALSE(Holds(config, "max_iterations"));  // lm's own
  EXPECT_FALSE(Holds(config, "petiole_width"));
  EXPECT_EQ(CheckConfig(first / "config.yaml", {}), 2U);
  const auto second = FitConfig(first / "config.yaml", {}, folder / "second", false, false);
  for (const char* file : {"runs.csv", "summary.csv", "config.yaml"}) {
    EXPECT_EQ(FileText(first / file), FileText(second / file)) << file;
  }
  // Both methods: their dependent defaults differ.
  const auto methods = Fit(folder,
                           "input: {synthetic_leaf: 1, points: 1500}\nproblem: {type: leaf}\n"
                           "sweep: {problem.method: [distance, paper]}\n",
                           "methods", {.set = "problem.surface.control_points=6", .seed = {}, .threads = 1});
  EXPECT_EQ(CheckConfig(methods / "config.yaml", {}), 2U);
}

TEST(Sweep, SweptScans_AreFoundFromTheConfigsFolderAndRepeated) {
  const TempFolder folder;
  WriteLeafFiles(folder, 1000, 100);
  std::filesystem::rename(folder / "scan.ply", folder / "a scan.ply");
  const auto run = Fit(folder,
                       "problem: {type: leaf, surface: {control_points: [6, 6]}}\n"
                       "sweep: {input.cloud: [a scan.ply, nowhere.ply]}\n",
                       "run");
  EXPECT_TRUE(Holds(FileText(run / "config.yaml"), "input.cloud: [\"" + (folder / "a scan.ply").string()));
  EXPECT_TRUE(Holds(FileText(run / "runs.csv"), "ok"));
}

TEST(Sweep, FailedRuns_AreRowsAndTheOthersGoOn) {
  const TempFolder folder;
  const auto run = Fit(folder,
                       "input: {synthetic_leaf: 1, points: 300}\n"
                       "problem: {type: leaf, surface: {control_points: [6, 6]}}\n"
                       "sweep: {problem.surface.control_points: [[6, 6], [40, 40]]}\n",
                       "run");
  const auto runs = FileText(run / "runs.csv");
  EXPECT_TRUE(Holds(runs, "ok"));
  EXPECT_TRUE(Holds(runs, "failed"));
  EXPECT_TRUE(Holds(runs, "cannot hold 40 x 40 control points"));
  EXPECT_TRUE(Holds(runs, "control_points,status,error,warnings,"));
}

TEST(Sweep, AllRunsFailed_IsAnErrorAndLeavesNothing) {
  const TempFolder folder;
  const std::string yaml = "input: {cloud: nowhere.ply}\nproblem: {type: leaf}\nsweep: {seed: [1, 2]}\n";
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { Fit(folder, yaml, "run"); }), "all 2 runs failed"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(Sweep, WrongValues_AreRefusedBeforeTheFirstRun) {
  const TempFolder folder;
  const auto complaint = [&](const std::string& end, const RunFlags& flags = {}) {
    return MessageOf<ConfigError>([&] {
      CheckConfig(folder.Write("fit.yaml", "input: {synthetic_leaf: 1}\nproblem: {type: leaf}\n" + end),
                  flags);
    });
  };
  EXPECT_TRUE(Holds(complaint("sweep: {problem.surface.degree: [3, 13]}\n"), "integers in [1, 12]"));
  EXPECT_TRUE(Holds(complaint("sweep: {problem.surfaec.degree: [2, 3]}\n"), "did you mean 'surface'?"));
  EXPECT_TRUE(
      Holds(complaint("sweep: {seed: [1, 2]}\noutput: {plot: {x: seed, y: rmse}}\n"), "'x' must name"));
  EXPECT_TRUE(
      Holds(complaint("sweep: {seed: [1, 2]}\n", {.set = "", .seed = 3, .threads = 1}), "leave out --seed"));
}

// Figure 9 of Wu et al. 2021, on two of the eight leaves of configs/leaf/point_count.yaml.
TEST(Sweep, PointCount_KeepsThePapersBoundsInTheMeanOfTheRepetitions) {
  const TempFolder folder;
  FitConfig(std::filesystem::path(FROND_SOURCE_DIR) / "configs/leaf/point_count.yaml",
            {.set = "sweep={input.synthetic_leaf: [3, 4], input.points: [300, 1000, 32000], seed: [1, 2, 3]}",
             .seed = {},
             .threads = 1},
            folder / "run", false, false);
  const auto summary = ReadCsv(folder / "run/summary.csv");
  ASSERT_EQ(summary.size(), 6U);
  for (const auto& row : summary) {
    EXPECT_EQ(row.at("failed"), "0");
    EXPECT_LT(std::stod(row.at("test_rmse")), 1) << row.at("input.points");
    EXPECT_LT(std::stod(row.at("test_max")), 2) << row.at("input.points");
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "run/plot.svg"));
}

}  // namespace
}  // namespace frond
