// SPDX-License-Identifier: BSD-3-Clause
// Meshes as input and regions through the program: what runs, what is refused and with which words.
#include <filesystem>

#include "io/mesh_file.h"
#include "io/metrics_json.h"
#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"
#include "tests/models/example_meshes.h"

namespace frond {
namespace {

// A bent sheet of 59 × 29.
SurfaceMesh BentSheet() {
  return GridMesh(60, 30, false, false,
                  [](int i, int j) { return Eigen::Vector3d(i, j, 0.01 * (j - 15) * (j - 15)); });
}

class MeshInput : public ::testing::Test {
 protected:
  ProgramResult Fit(const std::string& input) {
    folder_.Write("fit.yaml", "name: mesh\ninput: {" + input +
                                  "}\nproblem: {type: surface, surface: {degree: [3, 3], control_points: [6, "
                                  "6]}}\noutput: {formats: [json]}\n");
    return RunFrond({"fit", "fit.yaml", "--out=run", "--overwrite"}, folder_.path());
  }

  void ExpectFailure(const std::string& input, int code, const std::string& said) {
    const ProgramResult result = Fit(input);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, said)) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
  }

  TempFolder folder_;
};

TEST_F(MeshInput, Vertices_AreThePointsOfTheFit) {
  WriteMesh(folder_ / "sheet.ply", BentSheet(), "mm");
  const ProgramResult result = Fit("mesh: sheet.ply");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const RunMetrics metrics = ReadMetricsJson(folder_ / "run/metrics.json");
  EXPECT_EQ(metrics.input.points, 1800);
  EXPECT_EQ(metrics.input.sha256.size(), 64u);
  EXPECT_EQ(metrics.metrics.Find("repaired_welded_vertices"), nullptr);
  EXPECT_TRUE(Holds(FileText(folder_ / "run/config.yaml"), "mesh: "));
  // The written config repeats the run.
  std::filesystem::rename(folder_ / "run", folder_ / "first");
  EXPECT_EQ(RunFrond({"fit", "first/config.yaml", "--out=second"}, folder_.path()).exit_code, 0);
  EXPECT_EQ(FileText(folder_ / "first/surface.json"), FileText(folder_ / "second/surface.json"));
}

TEST_F(MeshInput, WithDefects_IsRefusedAndRepairedWhenAsked) {
  SurfaceMesh mesh = BentSheet();
  mesh.vertices.push_back(Eigen::Vector3d(mesh.vertices[70]));
  for (auto& triangle : mesh.triangles) {
    if (triangle[0] == 70) triangle[0] = 1800;
  }
  mesh.triangles.push_back(mesh.triangles[5]);
  mesh.triangles.push_back({3, 3, 4});
  mesh.vertices.emplace_back(500, 0, 0);
  WriteMesh(folder_ / "bad.ply", mesh, "mm");
  ExpectFailure("mesh: bad.ply", 3,
                "bad.ply: 1 duplicate vertices (first: vertex 1800), 1 degenerate faces (first: face 3423), "
                "1 duplicate faces (first: face 3422), 1 unreferenced vertices (first: vertex 1801); set "
                "input.repair to true");
  const ProgramResult result = Fit("mesh: bad.ply, repair: true");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const RunMetrics metrics = ReadMetricsJson(folder_ / "run/metrics.json");
  EXPECT_EQ(metrics.input.points, 1800);
  EXPECT_EQ(metrics.metrics.Number("repaired_welded_vertices"), 1);
  EXPECT_EQ(metrics.metrics.Number("repaired_degenerate_faces"), 1);
  EXPECT_EQ(metrics.metrics.Number("repaired_duplicate_faces"), 1);
  EXPECT_EQ(metrics.metrics.Number("repaired_unreferenced_vertices"), 1);
  EXPECT_TRUE(Holds(FileText(folder_ / "run/log.txt"), "repaired: 1 vertices welded"));
}

TEST_F(MeshInput, EdgeOfThreeFaces_IsRefusedUnlessTheRegionCutsItOff) {
  SurfaceMesh mesh = BentSheet();
  mesh.vertices.emplace_back(40, 3, 9);
  mesh.triangles.push_back({mesh.triangles[80][0], mesh.triangles[80][2], 1800});
  WriteMesh(folder_ / "fin.ply", mesh, "mm");
  ExpectFailure("mesh: fin.ply", 3, "fin.ply: has 1 edges with more than two faces");
  ExpectFailure("mesh: fin.ply, repair: true", 3, "cut them off with input.region");
  const ProgramResult result = Fit("mesh: fin.ply, region: [[0, 4, 0, 0, 1, 0]]");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(MeshInput, Region_KeepsWhatItsNormalsPointTo) {
  WriteMesh(folder_ / "sheet.ply", BentSheet(), "mm");
  for (const std::string file : {"mesh: sheet.ply", "cloud: sheet.ply"}) {
    const ProgramResult result = Fit(file + ", region: [[10, 0, 0, 1, 0, 0], [39.5, 0, 0, -1, 0, 0]]");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const RunMetrics metrics = ReadMetricsJson(folder_ / "run/metrics.json");
    // Faces are cut along the plane: new vertices on 30 edges along x and 29 diagonals.
    EXPECT_EQ(metrics.input.points, 30 * 30 + (file.starts_with("mesh") ? 59 : 0));
    EXPECT_EQ(metrics.metrics.Number("region_dropped"), 30 * 30);
    std::filesystem::remove_all(folder_ / "run");
    ExpectFailure(file + ", region: [[0, 0, 100, 0, 0, 1]]", 3, "the region keeps no ");
  }
}

TEST_F(MeshInput, WrongCombinations_AreConfigErrors) {
  WriteMesh(folder_ / "sheet.ply", BentSheet(), "mm");
  ExpectFailure("mesh: sheet.ply, cloud: sheet.ply", 2, "name one of 'cloud', 'mesh' and 'synthetic_leaf'");
  ExpectFailure("mesh: sheet.ply, points: 500", 2, "a mesh is not thinned: leave 'points' out");
  ExpectFailure("cloud: sheet.ply, repair: true", 2, "only a mesh is repaired");
  ExpectFailure("mesh: sheet.ply, region: [[0, 0, 0, 0, 0, 0]]", 2, "has the normal [0, 0, 0]");
  ExpectFailure("mesh: sheet.ply, region: [[0, 0, 0, 1]]", 2, "'region' in 'input'");
  ExpectFailure("mesh: sheet.ply, region: 7", 2, "'region' in 'input'");
  ExpectFailure("mesh: sheet.ply, repiar: true", 2, "(did you mean 'repair'?)");
}

TEST_F(MeshInput, FileWithoutFaces_IsRefused) {
  folder_.Write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  folder_.Write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder_.Write("out.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  ExpectFailure("mesh: points.xyz", 3, "unknown kind of mesh '.xyz'");
  ExpectFailure("mesh: points.obj", 3, "holds no faces");
  ExpectFailure("mesh: out.off", 3, "out.off");
  ExpectFailure("mesh: nowhere.ply", 3, "nowhere.ply: no such file");
}

}  // namespace
}  // namespace frond
