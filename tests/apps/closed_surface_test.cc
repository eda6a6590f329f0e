// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces through the program: what topology is taken, what is refused, and how well scanned objects
// are met. Those of the shared data are skipped where it is not there.
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <variant>

#include "io/mesh_file.h"
#include "io/metrics_json.h"
#include "io/surface_json.h"
#include "models/nurbs_surface.h"
#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"
#include "tests/models/example_meshes.h"

namespace frond {
namespace {

std::filesystem::path Shared(const std::string& file) {
  return std::filesystem::path(FROND_SHARED_DATA) / "closed" / file;
}

std::string Topology(const MetricTable& metrics) {
  const MetricValue* value = metrics.Find("topology");
  return value ? std::get<std::string>(*value) : "none";
}

class ClosedSurface : public ::testing::Test {
 protected:
  ProgramResult Fit(const std::string& input, const std::string& problem, const std::string& net = "[8, 8]",
                    const std::string& run = "run") {
    folder_.Write("fit.yaml", "name: closed\ninput: {" + input + "}\nproblem: {type: surface, " + problem +
                                  ", surface: {control_points: " + net + "}}\noutput: {formats: [json]}\n");
    return RunFrond({"fit", "fit.yaml", "--out=" + run, "--overwrite"}, folder_.path());
  }

  void ExpectFailure(const std::string& input, const std::string& problem, int code, const std::string& said,
                     const std::string& net = "[8, 8]") {
    const ProgramResult result = Fit(input, problem, net);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, said)) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
  }

  MetricTable Metrics(const std::string& run = "run") {
    return ReadMetricsJson(folder_ / (run + "/metrics.json")).metrics;
  }

  TempFolder folder_;
};

TEST_F(ClosedSurface, MeshOfAnotherTopology_IsRefused) {
  WriteMesh(folder_ / "open.ply", SphereMesh(24, 25, 10, 2), "mm");
  ExpectFailure("mesh: open.ply", "topology: sphere", 4, "problem.topology is 'sphere', but ");
  WriteMesh(folder_ / "torus.ply", TorusMesh(24, 16, 10, 4), "mm");
  for (const std::string topology : {"auto", "sphere", "tube"}) {
    ExpectFailure("mesh: torus.ply", "topology: " + topology, 4, "genus 1");
  }
  SurfaceMesh second = SphereMesh(24, 25, 10);
  for (auto& vertex : second.vertices) vertex.x() += 50;
  WriteMesh(folder_ / "two.ply", Together(SphereMesh(24, 25, 10), second), "mm");
  for (const std::string topology : {"auto", "sphere"}) {
    ExpectFailure("mesh: two.ply", "topology: " + topology, 4, "falls into 2 parts");
  }
  WriteMesh(folder_ / "sphere.ply", SphereMesh(24, 25, 10), "mm");
  for (const std::string topology : {"sheet", "tube", "cup"}) {
    ExpectFailure("mesh: sphere.ply", "topology: " + topology, 4, "is '" + topology + "', but ");
  }
}

TEST_F(ClosedSurface, WrongCombinations_AreConfigErrors) {
  WriteMesh(folder_ / "sphere.ply", SphereMesh(24, 25, 10), "mm");
  const std::string mesh = "mesh: sphere.ply", sphere = "topology: sphere";
  ExpectFailure(mesh, sphere + ", fit: {margin: trim}", 2, "no edges to trim");
  ExpectFailure(mesh, "topology: tube, fit: {margin: trim}", 2, "no edges to trim");
  ExpectFailure(mesh, sphere + ", fit: {unknowns: both}", 2, "weights are fixed");
  ExpectFailure(mesh, "topology: cup, fit: {unknowns: weights}", 2, "weights are fixed");
  ExpectFailure(mesh, sphere + ", fit: {method: ma}", 2, "weights are fixed");
  ExpectFailure(mesh, sphere + ", fit: {start: ma}", 2, "weights are fixed");
  ExpectFailure(mesh, sphere, 2, "surface.control_points", "[3, 8]");
  ExpectFailure(mesh, sphere, 2, "surface.control_points", "[8, 3]");
  ExpectFailure("cloud: sphere.ply, samples: 500", sphere, 2, "only a mesh has faces to sample");
  ExpectFailure(mesh, "topology: ball", 2, "topology");
}

TEST_F(ClosedSurface, SphereTubeAndCup_AreToldApartAndFitted) {
  struct Case {
    const char *name, *topology;
    SurfaceMesh mesh;
    double volume;
  };
  constexpr double kPi = std::numbers::pi;
  const Case cases[] = {{"sphere", "sphere", SphereMesh(40, 41, 10), 4000 * kPi / 3},
                        {"tube", "tube", TubeMesh(40, 40, 6, 30), 36 * 30 * kPi},
                        {"cup", "cup", SphereMesh(40, 25, 10, kPi / 2), 2000 * kPi / 3}};
  for (const Case& c : cases) {
    WriteMesh(folder_ / "mesh.ply", c.mesh, "mm");
    const ProgramResult result = Fit("mesh: mesh.ply", "topology: auto", "[10, 8]");
    ASSERT_EQ(result.exit_code, 0) << c.name << result.err;
    const MetricTable metrics = Metrics();
    EXPECT_EQ(Topology(metrics), c.topology);
    EXPECT_LT(metrics.Number("rmse"), 0.02) << c.name;
    EXPECT_EQ(metrics.Number("flipped_normals"), 0) << c.name;
    EXPECT_NEAR(metrics.Number("volume"), c.volume, 0.01 * c.volume) << c.name;
    EXPECT_EQ(metrics.Find("volume_error") != nullptr, std::string(c.name) == "sphere");
    EXPECT_TRUE(ReadSurfaceJson(folder_ / "run/surface.json").trimmed.surface.u().periodic());
  }
}

TEST_F(ClosedSurface, OtherWall_GivesTheVolumeBetween) {
  constexpr double kPi = std::numbers::pi;
  WriteMesh(folder_ / "inner.ply", SphereMesh(40, 25, 8, kPi / 2), "mm");
  WriteMesh(folder_ / "outer.ply", SphereMesh(40, 25, 10, kPi / 2), "mm");
  ASSERT_EQ(Fit("mesh: inner.ply", "topology: cup", "[10, 8]", "inner").exit_code, 0);
  EXPECT_EQ(Metrics("inner").Find("wall_volume"), nullptr);
  const ProgramResult result =
      Fit("mesh: outer.ply, other_wall: inner/surface.json", "topology: cup", "[10, 8]", "outer");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const double volume = 2 * kPi / 3 * (1000 - 512);
  EXPECT_NEAR(Metrics("outer").Number("wall_volume"), volume, 0.01 * volume);
  ExpectFailure("mesh: outer.ply, other_wall: nowhere.json", "topology: cup", 3, "nowhere.json");
}

TEST_F(ClosedSurface, Femur_IsRefusedForItsHandlesAndItsShaftIsATube) {
  const std::filesystem::path femur = Shared("cgal_femur.off");
  if (!std::filesystem::exists(femur)) GTEST_SKIP() << "no shared data: " << femur;
  const std::string input = "mesh: " + femur.string() + ", unit: m";
  for (const std::string topology : {"auto", "sphere"}) {
    ExpectFailure(input, "topology: " + topology, 4, "genus 2");
  }
  const ProgramResult result =
      Fit(input + ", region: [[0, 0, -0.05, 0, 0, 1], [0, 0, 0.3, 0, 0, -1]], samples: 4000",
          "topology: auto", "[12, 12]");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const MetricTable metrics = Metrics();
  EXPECT_EQ(Topology(metrics), "tube");
  EXPECT_EQ(metrics.Number("flipped_normals"), 0);
  EXPECT_LT(metrics.Number("rmse"), 0.002 * 0.35);
  EXPECT_NEAR(metrics.Number("area_error"), 0, 0.02);
}

TEST_F(ClosedSurface, Ventricles_AreCupsWithinTheirBounds) {
  struct Case {
    const char* file;
    double percent;
  };
  for (const Case& c : {Case{"lv_mean_ED_endo.off", 0.25}, Case{"lv_mean_ED_epi.off", 0.15}}) {
    const std::filesystem::path path = Shared(c.file);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data: " << path;
    const ProgramResult result =
        Fit("mesh: " + path.string() + ", repair: true", "topology: auto", "[20, 8]");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const MetricTable metrics = Metrics();
    EXPECT_EQ(Topology(metrics), "cup");
    EXPECT_LE(metrics.Number("relative_mean_percent"), c.percent) << c.file;
    EXPECT_EQ(metrics.Number("flipped_normals"), 0) << c.file;
  }
}

TEST_F(ClosedSurface, VentricleWithoutFaces_IsTheSameCup) {
  const std::filesystem::path path = Shared("lv_mean_ED_endo.off");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data: " << path;
  const ProgramResult result = Fit("cloud: " + path.string(), "topology: cup", "[20, 8]");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const MetricTable metrics = Metrics();
  EXPECT_LE(metrics.Number("relative_mean_percent"), 0.25);
  EXPECT_EQ(metrics.Number("flipped_normals"), 0);
  EXPECT_NEAR(metrics.Number("volume"), 129315, 0.002 * 129315);  // of the mesh's fit
}

TEST_F(ClosedSurface, Pear_IsWithinItsBounds) {
  const std::filesystem::path path = Shared("ycb_016_pear.obj");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data: " << path;
  const ProgramResult result = Fit("mesh: " + path.string() + ", unit: m, repair: true, samples: 10000",
                                   "topology: sphere", "[24, 24]");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : ReadMesh(path).vertices) box.extend(vertex);
  const double height = box.sizes().maxCoeff();
  const MetricTable metrics = Metrics();
  EXPECT_LE(metrics.Number("rmse"), 0.0005 * height);
  EXPECT_LE(metrics.Number("max"), 0.005 * height);
  EXPECT_LE(metrics.Number("mesh_reverse_max"), 0.005 * height);
  EXPECT_EQ(metrics.Number("flipped_normals"), 0);
  EXPECT_LE(std::abs(metrics.Number("volume_error")), 0.001);
  EXPECT_LE(std::abs(metrics.Number("area_error")), 0.0015);
}

}  // namespace
}  // namespace frond
