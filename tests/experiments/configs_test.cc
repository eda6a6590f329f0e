// SPDX-License-Identifier: BSD-3-Clause
// Every config of the repository runs, on a small scan and where needed with a smaller net or budget.
#include <algorithm>

#include "experiments/study/study.h"
#include "experiments/sweep.h"
#include "io/metrics_json.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

struct Shipped {
  const char* path;  // below configs/
  const char* set;   // what makes it small
};

const Shipped kConfigs[] = {
    {"leaf/auto.yaml", "output.formats=[json]"},
    {"leaf/conforming.yaml", ""},
    {"leaf/paper.yaml", ""},
    {"leaf/paper_ordered.yaml", ""},
    {"leaf/paper_pso.yaml", ""},
    {"leaf/paper_pso_lm.yaml", ""},
    {"leaf/tea_leaf.yaml", "problem.surface.control_points=[12, 12]"},
    {"surface/sheet.yaml", "problem.surface.control_points=[12, 12]"},
};
void PrintTo(const Shipped& config, std::ostream* out) { *out << config.path; }

constexpr char kSweep[] = "leaf/point_count.yaml";
constexpr char kStandard[] = "standard/misra1a.yaml";

struct ShippedStudyCase {
  const char* path;
  std::size_t jobs;
  const char* set;         // what makes it small
  std::size_t small_jobs;  // then
};

const ShippedStudyCase kStudies[] = {
    {"study/leaf_weights.yaml", 8 * 5 * 15,
     "study.repetitions=1; budget.evaluations=300; problems.leaf.leaves=[1]; problems.leaf.points=2000", 5},
    {"study/nist.yaml", 27 * 2 * 3, "budget.evaluations=300; problems.nist.problem=misra1a", 2 * 3},
    {"study/nist_random_starts.yaml", 27 * 3 * 100,
     "study.repetitions=2; budget.evaluations=300; problems.nist.problem=misra1a", 3 * 2},
    {"study/swarms.yaml", 3 * 28 * 20, "study.repetitions=1; budget.evaluations=300", 3 * 28},
};
void PrintTo(const ShippedStudyCase& study, std::ostream* out) { *out << study.path; }

const std::filesystem::path kFolder = std::filesystem::path(FROND_SOURCE_DIR) / "configs";

class ShippedConfig : public ::testing::TestWithParam<Shipped> {};

TEST_P(ShippedConfig, FitsASmallScan) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  std::string set =
      "input.cloud=" + (folder / "scan.ply").string() + "; input.truth=" + (folder / "truth.ply").string();
  if (*GetParam().set != '\0') set += std::string("; ") + GetParam().set;
  FitConfig(kFolder / GetParam().path, {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_EQ(run.status, "ok");
  EXPECT_EQ(run.input.points, 3000);
  // The bound of 40,000 points on the RMSE; slices of so few miss more of the margin's teeth.
  EXPECT_LT(run.metrics.Number("truth_rmse"), 0.45);
  EXPECT_LT(run.metrics.Number("truth_max"), 2);
  EXPECT_LE(run.metrics.Number("flipped_normals"), 0.002 * run.metrics.Number("surface_samples"));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedConfig, ::testing::ValuesIn(kConfigs), [](const auto& info) {
  return std::filesystem::path(info.param.path).stem().string();
});

class ShippedStudy : public ::testing::TestWithParam<ShippedStudyCase> {};

TEST_P(ShippedStudy, RunsSmall) {
  const TempFolder folder;
  const StudyOutcome outcome =
      RunStudy(kFolder / GetParam().path, {.set = GetParam().set, .seed = {}, .threads = 1}, folder / "run",
               {.workers = 2});
  EXPECT_EQ(outcome.jobs, GetParam().small_jobs);
  EXPECT_EQ(outcome.missing, 0U);
  EXPECT_EQ(outcome.failed, 0U) << FileText(folder / "run/runs.csv");
  EXPECT_FALSE(outcome.text.empty());
  EXPECT_EQ(ReportStudy(folder / "run").text, outcome.text);
  for (const char* file : {"runs.csv", "summary.csv", "summary.md", "report.html"}) {
    EXPECT_GT(std::filesystem::file_size(folder / "run" / file), 100U) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedStudy, ::testing::ValuesIn(kStudies), [](const auto& info) {
  return std::filesystem::path(info.param.path).stem().string();
});

TEST(ShippedConfigs, StandardProblem_IsSolvedToElevenDigits) {
  const TempFolder folder;
  FitConfig(kFolder / kStandard, {}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_EQ(run.input.points, 0);
  EXPECT_GT(run.metrics.Number("digits"), 10);
  FitConfig(folder / "run/config.yaml", {}, folder / "again", false, false);  // as it was resolved
  EXPECT_EQ(ReadMetricsJson(folder / "again/metrics.json").solver.objective, run.solver.objective);
}

TEST(ShippedConfigs, AreAllNamedHere) {
  std::vector<std::string> named = {kSweep, kStandard}, found;
  for (const Shipped& config : kConfigs) named.emplace_back(config.path);
  for (const ShippedStudyCase& study : kStudies) named.emplace_back(study.path);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kFolder)) {
    if (entry.is_regular_file()) found.push_back(std::filesystem::relative(entry.path(), kFolder));
  }
  std::sort(named.begin(), named.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, named) << "a config that is new needs a line in this test";
}

TEST(ShippedConfigs, AreRightAsTheyStand) {
  for (const Shipped& config : kConfigs) EXPECT_EQ(CheckConfig(kFolder / config.path, {}), 1U) << config.path;
  EXPECT_EQ(CheckConfig(kFolder / kSweep, {}), 8U * 8U * 10U);
  for (const ShippedStudyCase& study : kStudies) {
    EXPECT_EQ(CheckConfig(kFolder / study.path, {}), study.jobs) << study.path;
  }
}

}  // namespace
}  // namespace frond
