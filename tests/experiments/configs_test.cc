// SPDX-License-Identifier: BSD-3-Clause
// Every config of the repository runs, on a small scan and where needed with a smaller net or budget.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "experiments/study/study.h"
#include "experiments/sweep.h"
#include "experiments/synth.h"
#include "io/cad_file.h"
#include "io/curve_json.h"
#include "io/mesh_file.h"
#include "io/metrics_json.h"
#include "io/point_cloud_file.h"
#include "tests/experiments/leaf_files.h"
#include "tests/models/example_meshes.h"

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

// Objects whose scan is made by a formula of two shares, from 0 to 1: round the object, and along it.
struct ShippedObject {
  const char* path;
  Eigen::Vector3d (*surface)(double around, double along);
  const char* set;
  double largest_rmse;
};

// A cup, half of an ellipsoid along −x, as a ventricle is.
Eigen::Vector3d Cup(double around, double along) {
  const double angle = 2 * std::numbers::pi * around, polar = std::numbers::pi / 2 * along;
  return {80 * std::sin(polar), 25 * std::cos(polar) * std::cos(angle),
          22 * std::cos(polar) * std::sin(angle)};
}

// A third of a torus.
Eigen::Vector3d BentTube(double around, double along) {
  const double angle = 2 * std::numbers::pi * around, bend = 2 * std::numbers::pi / 3 * along;
  const double ring = 40 + 10 * std::cos(angle);
  return {ring * std::cos(bend), ring * std::sin(bend), 10 * std::sin(angle)};
}

const ShippedObject kObjects[] = {
    {"objects/bent_tube.yaml", BentTube, "", 0.1},
    {"objects/cloud.yaml", Cup, "input.points=400; solver.max_iterations=4; output.formats=[json]", 0.2},
    {"objects/ventricle_skin.yaml", Cup, "", 0.1},
};
void PrintTo(const ShippedObject& object, std::ostream* out) { *out << object.path; }
// Objects whose scan is a mesh.
struct ShippedMesh {
  const char* path;
  SurfaceMesh (*mesh)();
  const char* set;
  const char* topology;
  double volume;  // of the shape that the mesh is drawn in
};

SurfaceMesh Stretched(SurfaceMesh mesh, double along_z) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex.z() *= along_z;
  return mesh;
}
SurfaceMesh Fruit() { return Stretched(SphereMesh(48, 32, 0.04), 1.4); }
SurfaceMesh Ventricle() { return Stretched(SphereMesh(40, 25, 25, std::numbers::pi / 2), 3); }
SurfaceMesh Bone() { return TubeMesh(48, 101, 14, 440); }

const ShippedMesh kMeshes[] = {
    {"objects/bone_shaft.yaml", Bone, "input.samples=2000; problem.surface.control_points=[12, 10]", "tube",
     std::numbers::pi * 14 * 14 * 200},
    {"objects/pear.yaml", Fruit, "input.samples=2000; problem.surface.control_points=[12, 12]", "sphere",
     4 * std::numbers::pi / 3 * 0.04 * 0.04 * 0.04 * 1.4},
    {"objects/ventricle.yaml", Ventricle, "", "cup", 2 * std::numbers::pi / 3 * 25 * 25 * 25 * 3},
};
void PrintTo(const ShippedMesh& object, std::ostream* out) { *out << object.path; }

const char* const kCurves[] = {"curve/circle.yaml", "curve/closed_outline.yaml"};

// Run by photograph_configs_test.cc.
const char* const kOfPhotographs[] = {"stereo/calibrated_pair.yaml", "stereo/displacement.yaml",
                                      "stereo/pair.yaml", "turntable/pear.yaml"};

constexpr char kSweep[] = "leaf/point_count.yaml";
constexpr char kCone[] = "objects/cone.yaml";
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
    {"study/stereo_windows.yaml", 2 * 40 * 4 * 15,
     "study.repetitions=1; budget.evaluations=300; problems.near.windows=1; problems.far.windows=1", 2 * 4},
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

class ShippedObjects : public ::testing::TestWithParam<ShippedObject> {};

TEST_P(ShippedObjects, FitsASmallScan) {
  const TempFolder folder;
  std::string scan;
  for (int j = 0; j <= 40; ++j) {
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d p = GetParam().surface((i + 0.5 * (j % 2)) / 60.0, j / 40.0);
      scan += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    }
  }
  folder.Write("scan.xyz", scan);
  std::string set = "input.cloud=" + (folder / "scan.xyz").string();
  if (*GetParam().set != '\0') set += std::string("; ") + GetParam().set;
  FitConfig(kFolder / GetParam().path, {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_EQ(run.status, "ok");
  EXPECT_LT(run.metrics.Number("rmse"), GetParam().largest_rmse);
  EXPECT_LE(run.metrics.Number("flipped_normals"), 0.001 * run.metrics.Number("surface_samples"));
  // As it was resolved, with all its options: the same surface.
  FitConfig(folder / "run/config.yaml", {}, folder / "again", false, false);
  EXPECT_EQ(FileText(folder / "again/surface.json"), FileText(folder / "run/surface.json"));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedObjects, ::testing::ValuesIn(kObjects), [](const auto& info) {
  return std::filesystem::path(info.param.path).stem().string();
});

class ShippedMeshes : public ::testing::TestWithParam<ShippedMesh> {};

TEST_P(ShippedMeshes, FitsASmallMesh) {
  const TempFolder folder;
  WriteMesh(folder / "scan.ply", GetParam().mesh(), "mm");
  std::string set = "input.mesh=" + (folder / "scan.ply").string();
  if (*GetParam().set != '\0') set += std::string("; ") + GetParam().set;
  FitConfig(kFolder / GetParam().path, {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_EQ(run.status, "ok");
  EXPECT_EQ(std::get<std::string>(*run.metrics.Find("topology")), GetParam().topology);
  EXPECT_EQ(run.metrics.Number("flipped_normals"), 0);
  EXPECT_LT(run.metrics.Number("relative_mean_percent"), 0.3);
  EXPECT_NEAR(run.metrics.Number("volume") / GetParam().volume, 1, 0.005);  // facets take as much
}

INSTANTIATE_TEST_SUITE_P(All, ShippedMeshes, ::testing::ValuesIn(kMeshes), [](const auto& info) {
  return std::filesystem::path(info.param.path).stem().string();
});

TEST(ShippedConfigs, Ventricle_TellsTheVolumeOfItsWall) {
  const TempFolder folder;
  SurfaceMesh wall = Ventricle();
  const double inner = 2 * std::numbers::pi / 3 * 25 * 25 * 25 * 3;
  for (const char* name : {"inner", "outer"}) {
    WriteMesh(folder / (std::string(name) + ".ply"), wall, "mm");
    std::string set = "output.formats=[json]; input.mesh=" + (folder / (std::string(name) + ".ply")).string();
    if (name[0] == 'o') set += "; input.other_wall=" + (folder / "inner/surface.json").string();
    FitConfig(kFolder / "objects/ventricle.yaml", {.set = set, .seed = {}, .threads = 1}, folder / name,
              false, false);
    for (Eigen::Vector3d& vertex : wall.vertices) vertex *= 1.2;
  }
  const MetricTable metrics = ReadMetricsJson(folder / "outer/metrics.json").metrics;
  EXPECT_NEAR(metrics.Number("wall_volume") / inner, 1.2 * 1.2 * 1.2 - 1, 0.01);
}

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

TEST(ShippedConfigs, Cone_IsFoundExactlyFromSynthsPoints) {
  for (const char* kind : {"cylinder", "cone", "sphere", "torus"}) {
    const TempFolder folder;
    Synthesise(kind, "points=2000", 1, folder / "scan", false);
    const std::string set = "input.cloud=" + (folder / "scan/scan.ply").string() +
                            "; problem.fit.uncertainty=true; output.formats=[json]";
    FitConfig(kFolder / kCone, {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
    const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
    EXPECT_LT(run.metrics.Number("max"), 60e-6) << kind;  // a millionth of its size
    EXPECT_EQ(run.metrics.Number("outliers"), 0) << kind;
    EXPECT_NEAR(run.metrics.Number("perpendicular_mean"), run.metrics.Number("mean"), 1e-15) << kind;
    EXPECT_NEAR(run.metrics.Number("perpendicular_total"), 2000 * run.metrics.Number("mean"), 1e-9) << kind;
    EXPECT_EQ(run.metrics.Number("parametric_mean"), run.metrics.Number("perpendicular_mean")) << kind;
    EXPECT_LT(run.metrics.Number("uncertainty_max"), 1e-3) << kind;
    EXPECT_FALSE(ReadMesh(folder / "run/uncertainty.ply").triangles.empty()) << kind;
  }
}

TEST(ShippedConfigs, LinearMethods_FitTheConeNearly) {
  const TempFolder folder;
  Synthesise("cone", "points=2000", 1, folder / "scan", false);
  double last = 1;
  for (const char* method : {"parametric", "ma"}) {
    const std::string set = "input.cloud=" + (folder / "scan/scan.ply").string() +
                            "; problem.fit={unknowns: control_points, margin: none, method: " + method +
                            ", repetitions: 10}";
    const auto run = folder / method;
    FitConfig(kFolder / kCone, {.set = set, .seed = {}, .threads = 1}, run, false, false);
    const double rmse = ReadMetricsJson(run / "metrics.json").metrics.Number("rmse");
    EXPECT_LT(rmse, last) << method;
    EXPECT_LT(rmse, 0.1) << method;
    last = rmse;
  }
}

// Points of a circle of radius 5 around (1, 2, 3).
std::vector<Eigen::Vector3d> CirclePoints(int count) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.emplace_back(1 + 5 * std::cos(angle), 2 + 5 * std::sin(angle), 3);
  }
  return points;
}

TEST(ShippedConfigs, Circle_IsExact) {
  const TempFolder folder;
  WritePointCloud(folder / "points.csv", {CirclePoints(60)});
  const std::string set =
      "input.cloud=" + (folder / "points.csv").string() + "; output.formats=[step,iges,json,ply,obj]";
  FitConfig(kFolder / kCurves[0], {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_LT(run.metrics.Number("max"), 1e-8);
  EXPECT_LT(run.metrics.Number("relative_mean_percent"), 1e-7);
  EXPECT_NEAR(run.metrics.Number("length"), 10 * std::numbers::pi, 1e-7);
  EXPECT_EQ(run.metrics.Number("control_points"), 6);
  const NurbsCurve curve = ReadCurveJson(folder / "run/curve.json").curve;
  EXPECT_TRUE(curve.basis().periodic());
  for (const NurbsCurve& read :
       {ReadStepCurve(folder / "run/curve.step").curve, ReadIgesCurve(folder / "run/curve.igs").curve}) {
    for (double t = 0; t <= 1; t += 0.01) {
      EXPECT_NEAR((read.Evaluate(t) - Eigen::Vector3d(1, 2, 3)).norm(), 5, 1e-7);
    }
  }
  EXPECT_EQ(ReadPointCloud(folder / "run/deviation.ply").points.size(), 60U);
  EXPECT_EQ(ReadPointCloud(folder / "run/curve.ply").points.size(), 3U * 16 + 1);
  EXPECT_EQ(ReadPointCloud(folder / "run/curve.obj").points.size(), 3U * 16 + 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "run/surface.json"));
  const std::string mesh = "input.cloud=" + (folder / "points.csv").string() + "; output.formats=[stl]";
  EXPECT_THROW(
      FitConfig(kFolder / kCurves[0], {.set = mesh, .seed = {}, .threads = 1}, folder / "no", false, false),
      ConfigError);
}

TEST(ShippedConfigs, ClosedOutline_IsFoundFromUnorderedPoints) {
  const TempFolder folder;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 400; ++i) {  // every 171st of 400: in no order along the curve
    const double angle = 2 * std::numbers::pi * (i * 171 % 400) / 400, radius = 30 + 3 * std::cos(3 * angle);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  WritePointCloud(folder / "points.csv", {points});
  const std::string set = "input.cloud=" + (folder / "points.csv").string();
  FitConfig(kFolder / kCurves[1], {.set = set, .seed = {}, .threads = 1}, folder / "run", false, false);
  const RunMetrics run = ReadMetricsJson(folder / "run/metrics.json");
  EXPECT_EQ(run.status, "ok");
  EXPECT_LT(run.metrics.Number("max"), 0.03);
  FitConfig(folder / "run/config.yaml", {}, folder / "again", false, false);  // as it was resolved
  EXPECT_EQ(FileText(folder / "again/curve.json"), FileText(folder / "run/curve.json"));
}

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
  std::vector<std::string> named = {kSweep, kStandard, kCone}, found;
  for (const Shipped& config : kConfigs) named.emplace_back(config.path);
  for (const ShippedObject& object : kObjects) named.emplace_back(object.path);
  for (const ShippedMesh& object : kMeshes) named.emplace_back(object.path);
  for (const char* config : kCurves) named.emplace_back(config);
  for (const ShippedStudyCase& study : kStudies) named.emplace_back(study.path);
  for (const char* config : kOfPhotographs) named.emplace_back(config);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kFolder)) {
    if (entry.is_regular_file()) found.push_back(std::filesystem::relative(entry.path(), kFolder));
  }
  std::sort(named.begin(), named.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, named) << "a config that is new needs a line in this test";
}

TEST(ShippedConfigs, AreRightAsTheyStand) {
  for (const Shipped& config : kConfigs) EXPECT_EQ(CheckConfig(kFolder / config.path, {}), 1U) << config.path;
  for (const ShippedObject& object : kObjects)
    EXPECT_EQ(CheckConfig(kFolder / object.path, {}), 1U) << object.path;
  for (const ShippedMesh& object : kMeshes)
    EXPECT_EQ(CheckConfig(kFolder / object.path, {}), 1U) << object.path;
  for (const char* config : kCurves) EXPECT_EQ(CheckConfig(kFolder / config, {}), 1U) << config;
  for (const char* config : kOfPhotographs) EXPECT_EQ(CheckConfig(kFolder / config, {}), 1U) << config;
  EXPECT_EQ(CheckConfig(kFolder / kSweep, {}), 8U * 8U * 10U);
  for (const ShippedStudyCase& study : kStudies) {
    EXPECT_EQ(CheckConfig(kFolder / study.path, {}), study.jobs) << study.path;
  }
}

}  // namespace
}  // namespace frond
