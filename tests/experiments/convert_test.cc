// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/convert.h"

#include <cmath>

#include "base/errors.h"
#include "experiments/synth.h"
#include "io/curve_file.h"
#include "io/mesh_file.h"
#include "io/point_cloud_file.h"
#include "io/surface_file.h"
#include "models/knot_vector.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

class ConvertTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    WriteLeafFiles(*folder_);
    Fit(*folder_,
        "input: {cloud: scan.ply}\nproblem: {type: leaf, surface: {control_points: [8, 8]}}\n"
        "output: {formats: [json, ply]}\n",
        "run");
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static inline TempFolder* folder_ = nullptr;
};

TEST_F(ConvertTest, SurfaceThroughStepAndIges_KeepsItsShape) {
  const SurfaceDocument first = ReadSurface(*folder_ / "run/surface.json");
  for (const char* file : {"a.step", "a.stp", "a.igs", "a.iges"}) {
    Convert(*folder_ / "run/surface.json", *folder_ / file);
    Convert(*folder_ / file, *folder_ / "back.json");
    const NurbsSurface back = ReadSurface(*folder_ / "back.json").trimmed.surface;
    for (int k = 0; k < 100; ++k) {
      const double u = std::fmod(0.618 * k, 1), v = std::fmod(0.414 * k, 1);
      EXPECT_LT((back.Evaluate(u, v) - first.trimmed.surface.Evaluate(u, v)).norm(), 1e-9 * 60) << file;
    }
  }
}

TEST_F(ConvertTest, SurfaceToMesh_HasTrianglesInsideTheTrim) {
  for (const char* file : {"m.ply", "m.obj", "m.stl"}) {
    Convert(*folder_ / "run/surface.json", *folder_ / file);
    EXPECT_GT(ReadMesh(*folder_ / file).triangles.size(), 100U) << file;
  }
  Convert(*folder_ / "run/surface.json", *folder_ / "m.glb");
  EXPECT_TRUE(FileText(*folder_ / "m.glb").starts_with("glTF"));
}

TEST_F(ConvertTest, CloudThroughText_KeepsEveryBit) {
  const PointCloud first = ReadPointCloud(*folder_ / "scan.ply");
  for (const char* file : {"c.xyz", "c.asc", "c.csv", "c.txt"}) {
    Convert(*folder_ / "scan.ply", *folder_ / file);
    Convert(*folder_ / file, *folder_ / "back.ply");
    EXPECT_EQ(ReadPointCloud(*folder_ / "back.ply").points, first.points) << file;
  }
}

TEST_F(ConvertTest, MeshToMeshOrToItsVertices_ByTheTarget) {
  const std::size_t triangles = ReadMesh(*folder_ / "run/surface.ply").triangles.size();
  Convert(*folder_ / "run/surface.ply", *folder_ / "n.obj");
  EXPECT_EQ(ReadMesh(*folder_ / "n.obj").triangles.size(), triangles);
  Convert(*folder_ / "run/surface.ply", *folder_ / "n.xyz");
  EXPECT_EQ(ReadPointCloud(*folder_ / "n.xyz").points.size(),
            ReadPointCloud(*folder_ / "run/surface.ply").points.size());
}

TEST(ConvertCurve, ThroughEveryFormat_KeepsItsShape) {
  const TempFolder folder;
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {3, 1, 0}, {4, 5, 2}, {1, 7, 1}, {0, 4, 3}};
  const CurveDocument first{NurbsCurve(UniformBasis(3, 5), points, {1, 2, 1, 0.5, 1}), "cm"};
  WriteCurve(folder / "curve.json", first);
  for (const char* file : {"a.json", "a.step", "a.stp", "a.igs", "a.iges"}) {
    Convert(folder / "curve.json", folder / file);
    Convert(folder / file, folder / "back.json");
    const CurveDocument back = ReadCurve(folder / "back.json");
    EXPECT_EQ(back.unit, "cm") << file;
    for (int k = 0; k <= 50; ++k) {
      EXPECT_LT((back.curve.Evaluate(k / 50.0) - first.curve.Evaluate(k / 50.0)).norm(), 1e-12 * 10) << file;
    }
  }
  Convert(folder / "a.step", folder / "line.ply");
  EXPECT_GE(ReadPointCloud(folder / "line.ply").points.size(), 32U);
  Convert(folder / "curve.json", folder / "line.obj");
  EXPECT_TRUE(Holds(FileText(folder / "line.obj"), "\nl 1 2 3 "));
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { Convert(folder / "curve.json", folder / "a.stl"); }),
                    "a curve is written as json, step"));
}

TEST_F(ConvertTest, PairsThatMakeNoSense_AreRefused) {
  const auto refused = [&](const char* in, const char* out) {
    return MessageOf<ConfigError>([&] { Convert(*folder_ / in, *folder_ / out); });
  };
  EXPECT_TRUE(Holds(refused("scan.ply", "x.step"), "cannot convert .ply to .step"));
  EXPECT_TRUE(Holds(refused("run/surface.json", "x.csv"), "a surface is written as"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { Convert(*folder_ / "x.docx", *folder_ / "x.ply"); }),
                    "unknown format"));
  EXPECT_TRUE(
      Holds(MessageOf<InputError>([&] { Convert(*folder_ / "x.ply", *folder_ / "x.xyz"); }), "no such file"));
}

TEST(Synthesise, SameSeed_GivesTheSameBytes) {
  const TempFolder folder;
  const std::string set = "points=1500; dense_points=1000; holes=2; petiole_length=5; outlier_share=0.01";
  Synthesise("leaf", set, 5, folder / "a", false);
  Synthesise("leaf", set, 5, folder / "b", false);
  for (const char* file : {"scan.ply", "clean.ply", "truth.ply", "truth.json", "config.yaml"}) {
    EXPECT_TRUE(FileText(folder / "a" / file) == FileText(folder / "b" / file)) << file;
  }
  Synthesise("leaf", set, 6, folder / "c", false);
  EXPECT_FALSE(FileText(folder / "a/scan.ply") == FileText(folder / "c/scan.ply"));
  EXPECT_EQ(ReadPointCloud(folder / "a/scan.ply").points.size(), 1500U);
}

TEST(Synthesise, WrongOptions_AreRefusedWithNothingLeft) {
  const TempFolder folder;
  EXPECT_THROW(Synthesise("leaf", "noise=-1", 1, folder / "a", false), ConfigError);
  EXPECT_THROW(Synthesise("tree", "", 1, folder / "a", false), ConfigError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace frond
