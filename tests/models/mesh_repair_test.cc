// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_repair.h"

#include <gtest/gtest.h>

#include <numbers>

#include "models/mesh_topology.h"
#include "tests/models/example_meshes.h"

namespace frond {
namespace {

TEST(MeshDefects, CleanMesh_HasNone) {
  EXPECT_TRUE(FindMeshDefects(SphereMesh(12, 9, 2)).none());
  EXPECT_TRUE(FindMeshDefects(TorusMesh(12, 9, 5, 2)).none());
}

TEST(MeshDefects, EachKind_IsCountedWithItsFirst) {
  SurfaceMesh mesh = SheetMesh(4, 4);
  mesh.vertices.push_back(Eigen::Vector3d(mesh.vertices[3]));  // 16, without a face
  mesh.vertices.emplace_back(9, 9, 9);                         // 17
  mesh.triangles.push_back({1, 2, 3});                         // 18, on one line
  mesh.triangles.push_back({1, 1, 4});                         // 19
  mesh.triangles.push_back({5, 0, 1});                         // 20, as face 0
  mesh.triangles.push_back({1, 0, 5});                         // 21, against it
  const MeshDefects defects = FindMeshDefects(mesh);
  EXPECT_EQ(defects.duplicate_vertices, 1);
  EXPECT_EQ(defects.first_duplicate_vertex, 16);
  EXPECT_EQ(defects.degenerate_faces, 2);
  EXPECT_EQ(defects.first_degenerate_face, 18);
  EXPECT_EQ(defects.duplicate_faces, 2);
  EXPECT_EQ(defects.first_duplicate_face, 20);
  EXPECT_EQ(defects.unreferenced_vertices, 2);
  EXPECT_EQ(defects.first_unreferenced_vertex, 16);
  EXPECT_EQ(defects.InWords(),
            "1 duplicate vertices (first: vertex 16), 2 degenerate faces (first: face 18), "
            "2 duplicate faces (first: face 20), 2 unreferenced vertices (first: vertex 16)");
}

TEST(RepairMesh, CleanMesh_StaysToTheBit) {
  const SurfaceMesh mesh = TorusMesh(12, 9, 5, 2);
  MeshRepairCounts counts;
  const SurfaceMesh repaired = RepairMesh(mesh, &counts);
  EXPECT_EQ(repaired.vertices, mesh.vertices);
  EXPECT_EQ(repaired.triangles, mesh.triangles);
  EXPECT_EQ(counts.welded_vertices + counts.degenerate_faces + counts.duplicate_faces + counts.swapped_edges +
                counts.split_vertices + counts.unreferenced_vertices,
            0);
}

TEST(RepairMesh, OpenSeamsAndPoleRows_AreWelded) {
  // A sphere as a plain grid: its seam twice, each pole a whole row.
  const int columns = 13, rows = 7;
  const SurfaceMesh grid = GridMesh(columns, rows, false, false, [&](int i, int j) {
    const double u = 2 * std::numbers::pi * (i % (columns - 1)) / (columns - 1);
    const double v = std::numbers::pi * j / (rows - 1), r = j == 0 || j == rows - 1 ? 0 : std::sin(v);
    return Eigen::Vector3d(r * std::cos(u), r * std::sin(u), -std::cos(v));
  });
  MeshRepairCounts counts;
  const SurfaceMesh repaired = RepairMesh(grid, &counts);
  const MeshTopology topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
  EXPECT_EQ(topology.genus, 0);
  EXPECT_EQ(repaired.vertices.size(), 2 + 12 * 5u);
  EXPECT_EQ(counts.welded_vertices, 5 + 2 * 12);
  EXPECT_EQ(counts.degenerate_faces, 24);
  EXPECT_EQ(counts.unreferenced_vertices, 0);
  EXPECT_TRUE(FindMeshDefects(repaired).none());
}

TEST(RepairMesh, FlapWithoutThickness_GoesWithBothFaces) {
  SurfaceMesh mesh = SphereMesh(8, 7, 1);
  const MeshTopology before = FindMeshTopology(mesh);
  const auto [a, b, c] = mesh.triangles[6];
  mesh.vertices.emplace_back(0, 0, 3);
  const int tip = static_cast<int>(mesh.vertices.size()) - 1;
  mesh.triangles.push_back({a, b, tip});
  mesh.triangles.push_back({b, a, tip});
  MeshRepairCounts counts;
  const SurfaceMesh repaired = RepairMesh(mesh, &counts);
  EXPECT_EQ(counts.duplicate_faces, 2);
  EXPECT_EQ(counts.unreferenced_vertices, 1);
  const MeshTopology topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.manifold && topology.closed);
  EXPECT_EQ(topology.faces, before.faces);
}

TEST(RepairMesh, RepeatedFace_LosesOneOfThePair) {
  SurfaceMesh mesh = SphereMesh(8, 7, 1);
  mesh.triangles.push_back({mesh.triangles[9][1], mesh.triangles[9][2], mesh.triangles[9][0]});
  MeshRepairCounts counts;
  EXPECT_EQ(RepairMesh(mesh, &counts).triangles, SphereMesh(8, 7, 1).triangles);
  EXPECT_EQ(counts.duplicate_faces, 1);
}

TEST(RepairMesh, FaceOnALine_GoesBySwappingItsLongestSide) {
  // Vertex 4 lies on the side 0–2 of both halves of a square, which one half ends at and the other does not.
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}};
  ASSERT_EQ(FindMeshDefects(mesh).degenerate_faces, 1);
  MeshRepairCounts counts;
  const SurfaceMesh repaired = RepairMesh(mesh, &counts);
  EXPECT_EQ(counts.swapped_edges, 1);
  EXPECT_TRUE(FindMeshDefects(repaired).none());
  const MeshTopology topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.manifold && topology.oriented);
  EXPECT_EQ(topology.euler_characteristic, 1);
  EXPECT_EQ(topology.boundary_loops.size(), 1u);
  EXPECT_NEAR(MeshArea(repaired), 4, 1e-14);
}

TEST(RepairMesh, PartsThatTouch_StayTwoManifolds) {
  SurfaceMesh one = SphereMesh(8, 7, 1), other = one;
  for (auto& vertex : other.vertices) vertex.z() += 2;  // pole on pole
  SurfaceMesh repaired = RepairMesh(Together(one, other));
  MeshTopology topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.manifold && topology.closed);
  EXPECT_EQ(topology.components.size(), 2u);
  EXPECT_EQ(topology.euler_characteristic, 4);

  // Two bricks with a common edge: welding it would give it four faces.
  const SurfaceMesh square =
      GridMesh(2, 2, false, false, [](int i, int j) { return Eigen::Vector3d(i, j, 0); });
  SurfaceMesh folded = square, upright = square, down = square;
  for (auto& vertex : upright.vertices) vertex = {0, vertex.y(), 0.5 + vertex.x() - 0.5};
  for (auto& vertex : down.vertices) vertex = {0, vertex.y(), -vertex.x()};
  repaired = RepairMesh(Together(Together(folded, upright), down));
  topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.manifold);
  EXPECT_EQ(topology.components.size(), 3u);
}

}  // namespace
}  // namespace frond
