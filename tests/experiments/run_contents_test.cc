// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "io/cad_file.h"
#include "io/mesh_file.h"
#include "io/metrics_json.h"
#include "io/point_cloud_file.h"
#include "io/sha256.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

const std::string kFit =
    "name: contents\nseed: 42\ninput: {cloud: scan.ply, truth: truth.ply}\n"
    "problem: {type: leaf, surface: {control_points: [8, 8]}}\n";

std::vector<std::string> KeysOf(const nlohmann::ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

TEST(RunContents, AreThoseOfTheDesign) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const auto run = Fit(folder, kFit + "output: {formats: [step, iges, json, ply, obj, stl, glb]}\n", "run");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(run)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"config.yaml", "deviation.ply", "log.txt", "metrics.json",
                                             "outliers.csv", "surface.glb", "surface.igs", "surface.json",
                                             "surface.obj", "surface.ply", "surface.step", "surface.stl",
                                             "trace.csv"}));
  // The scan, a fit.yaml, a truth and the run: no partial folder is left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 4);
  EXPECT_TRUE(CheckCadFile(run / "surface.step").valid);
  EXPECT_TRUE(CheckCadFile(run / "surface.igs").valid);
  EXPECT_EQ(ReadPointCloud(run / "deviation.ply").points.size(), 3000U);
  EXPECT_GT(ReadMesh(run / "surface.ply").triangles.size(), 100U);
  EXPECT_TRUE(Holds(FileText(run / "log.txt"), "stage fit"));
}

TEST(RunContents, SurfaceJson_IsThereWhateverTheFormats) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const auto run = Fit(folder, kFit + "output: {formats: [obj]}\n", "run");
  EXPECT_TRUE(std::filesystem::exists(run / "surface.json"));
  EXPECT_TRUE(std::filesystem::exists(run / "surface.obj"));
  EXPECT_FALSE(std::filesystem::exists(run / "surface.step"));
}

TEST(RunContents, MetricsJson_HasEveryKeyOfTheDesign) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const auto run = Fit(folder, kFit + "output: {formats: [json]}\n", "run");
  const auto json = nlohmann::ordered_json::parse(FileText(run / "metrics.json"));
  EXPECT_EQ(KeysOf(json), (std::vector<std::string>{"schema", "problem", "status", "error", "unit", "input",
                                                    "metrics", "solver", "stages", "seconds",
                                                    "peak_rss_bytes", "threads", "seed", "versions"}));
  EXPECT_EQ(json["schema"], "frond.metrics/1");
  EXPECT_EQ(json["problem"], "leaf");
  EXPECT_EQ(json["status"], "ok");
  EXPECT_TRUE(json["error"].is_null());
  EXPECT_EQ(json["input"]["sha256"], Sha256(FileText(folder / "scan.ply")));
  EXPECT_EQ(json["input"]["points"], 3000);
  EXPECT_EQ(json["seed"], 42);
  for (const char* key : {"rmse", "max", "mean", "p95", "reverse_p95", "reverse_max", "area"}) {
    EXPECT_GT(json["metrics"][key].get<double>(), 0) << key;
  }
  EXPECT_EQ(json["metrics"]["control_points"], (std::vector<int>{8, 8}));
  for (const char* key : {"flipped_normals", "outliers", "inlier_rmse", "local_noise", "data_coverage",
                          "truth_rmse", "truth_max", "dropped_not_finite", "merged_duplicates", "warnings"}) {
    EXPECT_TRUE(json["metrics"].contains(key)) << key;
  }
  for (const char* key : {"objective", "evaluations", "residual_evaluations", "jacobian_evaluations",
                          "iterations", "seconds"}) {
    EXPECT_GT(json["solver"][key].get<double>(), 0) << key;
  }
  EXPECT_EQ(json["solver"]["name"], "lm");
  for (const char* key : {"frond", "ceres", "git", "dirty"})
    EXPECT_TRUE(json["versions"].contains(key)) << key;
}

TEST(RunContents, PaperRuns_HaveTheSameKeysAndTheirOwn) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const auto run = Fit(folder,
                       "input: {cloud: scan.ply}\nproblem: {type: leaf, method: paper}\n"
                       "output: {formats: [json]}\n",
                       "run");
  const RunMetrics metrics = ReadMetricsJson(run / "metrics.json");
  for (const char* key :
       {"rmse", "max", "mean", "p95", "reverse_p95", "reverse_max", "area", "flipped_normals", "outliers",
        "inlier_rmse", "test_rmse", "test_max", "midrib_offset"}) {
    EXPECT_TRUE(std::isfinite(metrics.metrics.Number(key))) << key;
  }
  EXPECT_EQ(metrics.metrics.Number("test_points"), 90);
  EXPECT_EQ(metrics.solver.name, "none");
  EXPECT_EQ(metrics.solver.termination, "not_needed");
}

TEST(RunContents, RowsThatAreNotFinite_AreCountedAndChangeNothing) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  const PointCloud cloud = ReadPointCloud(folder / "scan.ply");
  WritePointCloud(folder / "scan.xyz", cloud);
  const std::string text = FileText(folder / "scan.xyz");
  folder.Write("holed.xyz",
               "nan nan nan\n1 2 nan\n" + text + "inf 0 0\n" + text.substr(0, text.find('\n') + 1));
  const std::string fit =
      "problem: {type: leaf, surface: {control_points: [8, 8]}}\noutput: {formats: [json]}\n";
  const auto whole = Fit(folder, "input: {cloud: scan.xyz}\n" + fit, "whole");
  const auto holed = Fit(folder, "input: {cloud: holed.xyz}\n" + fit, "holed");
  const RunMetrics metrics = ReadMetricsJson(holed / "metrics.json");
  EXPECT_EQ(metrics.metrics.Number("dropped_not_finite"), 3);
  EXPECT_EQ(metrics.metrics.Number("merged_duplicates"), 1);
  EXPECT_EQ(metrics.input.points, 3000);
  EXPECT_EQ(FileText(whole / "surface.json"), FileText(holed / "surface.json"));
}

TEST(RunContents, Outliers_AreListedByIndexWithTheirDistance) {
  const TempFolder folder;
  WriteLeafFiles(folder);
  PointCloud cloud = ReadPointCloud(folder / "scan.ply");
  cloud.points[700] += Eigen::Vector3d(40, 50, 60);
  WritePointCloud(folder / "far.ply", cloud);
  const auto run = Fit(folder,
                       "input: {cloud: far.ply}\nproblem: {type: leaf, surface: {control_points: [8, 8]}}\n"
                       "output: {formats: [json]}\n",
                       "run");
  const std::string csv = FileText(run / "outliers.csv");
  EXPECT_TRUE(csv.starts_with("index,x,y,z,signed_distance\n"));
  EXPECT_TRUE(Holds(csv, "\n700,"));
  EXPECT_EQ(static_cast<double>(std::count(csv.begin(), csv.end(), '\n') - 1),
            ReadMetricsJson(run / "metrics.json").metrics.Number("outliers"));
}

TEST(RunContents, TruthOfASyntheticLeaf_GivesTheAreaErrorToo) {
  const TempFolder folder;
  const auto run = Fit(folder,
                       "input: {synthetic_leaf: 2, points: 4000}\n"
                       "problem: {type: leaf, surface: {control_points: [10, 10]}}\n"
                       "output: {formats: [json]}\n",
                       "run");
  const MetricTable metrics = ReadMetricsJson(run / "metrics.json").metrics;
  EXPECT_LT(metrics.Number("truth_rmse"), 0.06);
  EXPECT_LT(std::abs(metrics.Number("area_error")), 0.02);
  EXPECT_EQ(ReadMetricsJson(run / "metrics.json").input.path, "synthetic leaf 2");
}

}  // namespace
}  // namespace frond
