// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "tests/io/sample_surfaces.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

// A 6 × 5 grid over a wavy sheet, moved by `offset`.
SurfaceMesh SampleMesh(const Eigen::Vector3d& offset) {
  const NurbsSurface surface = WavySheet(3, 3, 8, 6, false);
  SurfaceMesh mesh;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      const SurfacePoint p = surface.EvaluateWithDerivatives(i / 5.0, j / 4.0);
      mesh.vertices.push_back(p.position + offset);
      mesh.normals.push_back(p.Normal());
      mesh.parameters.emplace_back(i / 5.0, j / 4.0);
      if (i == 5 || j == 4) continue;
      const int a = 5 * i + j;
      mesh.triangles.push_back({a, a + 5, a + 6});
      mesh.triangles.push_back({a, a + 6, a + 1});
    }
  }
  return mesh;
}

TEST(MeshFile, PlyAndObj_ReadBackToTheBit) {
  const TempFolder folder;
  const SurfaceMesh mesh = SampleMesh({476773.25, 5429145.5, 0.1});
  for (const char* name : {"a.ply", "a.obj"}) {
    for (const bool bare : {false, true}) {
      SurfaceMesh written = mesh;
      if (bare) written.normals.clear(), written.parameters.clear();
      WriteMesh(folder / name, written, "m");
      const SurfaceMesh read = ReadMesh(folder / name);
      EXPECT_EQ(read.vertices, mesh.vertices) << name;
      EXPECT_EQ(read.triangles, mesh.triangles) << name;
    }
  }
}

TEST(MeshFile, Stl_ReadsBackToFloatPrecisionWithSharedVertices) {
  const TempFolder folder;
  const SurfaceMesh mesh = SampleMesh({0, 0, 0});
  WriteMesh(folder / "a.stl", mesh, "mm");
  EXPECT_EQ(std::filesystem::file_size(folder / "a.stl"), 84 + 50 * mesh.triangles.size());
  const SurfaceMesh read = ReadMesh(folder / "a.stl");
  ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
  ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& a = read.vertices[static_cast<std::size_t>(read.triangles[t][k])];
      const auto& b = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      EXPECT_LT((a - b).norm(), 1e-5);
    }
  }
}

TEST(MeshFile, PolygonsAndNegativeIndices_BecomeTriangles) {
  const TempFolder folder;
  const auto path = folder.Write(
      "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -4 -3 -2\n");
  const SurfaceMesh mesh = ReadMesh(path);
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
}

TEST(MeshFile, BadFiles_AreRefusedWithTheirPlace) {
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& text) {
    const auto path = folder.Write(name, text);
    return MessageOf<InputError>([&] { ReadMesh(path); });
  };
  EXPECT_TRUE(
      Holds(error("a.obj", "v 0 0 0\nf 1 2 3\n"), "line 2: a face names a vertex that does not exist"));
  EXPECT_TRUE(Holds(error("a.obj", "v 0 0 x\n"), "line 1: a word is not a number"));
  EXPECT_TRUE(Holds(error("a.obj", "v 0 0 0\n"), "holds no faces"));
  EXPECT_TRUE(Holds(error("a.off", "OFF\n1000000000 1 0\n0 0 0\n"), "promises 1e+09 points, 1 are there"));
  EXPECT_TRUE(Holds(error("a.off", "COFF2\n"), "is not an OFF file"));
  EXPECT_TRUE(Holds(error("a.stl", std::string(84, '\xff')), "room for 0"));
  EXPECT_TRUE(Holds(error("a.stl", "solid a\nvertex 0 0 0\n"), "is truncated"));
  EXPECT_TRUE(Holds(error("a.glb", "x"), "unknown kind of mesh '.glb' (known: ply, obj, stl, off)"));
  EXPECT_TRUE(Holds(error("a.obj", ""), "is empty"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] {
                      WriteMesh(folder / "a.fbx", SampleMesh({0, 0, 0}), "mm");
                    }),
                    "not written as '.fbx' (known: ply, obj, stl, glb)"));
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] {
                      WriteMesh(folder / "a.ply", SampleMesh({0, 0, 0}), "league");
                    }),
                    "unknown unit of length 'league'"));
}

}  // namespace
}  // namespace frond
