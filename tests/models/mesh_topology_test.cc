// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "tests/models/example_meshes.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(MeshTopology, Sheet_IsADiscWithOneRim) {
  const MeshTopology topology = FindMeshTopology(SheetMesh(5, 4));
  EXPECT_EQ(topology.components.size(), 1u);
  EXPECT_EQ(topology.euler_characteristic, 1);
  EXPECT_EQ(topology.genus, 0);
  EXPECT_TRUE(topology.manifold && topology.oriented && topology.orientable);
  EXPECT_FALSE(topology.closed);
  ASSERT_EQ(topology.boundary_loops.size(), 1u);
  // From the lowest vertex with the faces on the left.
  EXPECT_EQ(topology.boundary_loops[0], (std::vector<int>{0, 1, 2, 3, 4, 9, 14, 19, 18, 17, 16, 15, 10, 5}));
}

TEST(MeshTopology, Tube_HasTwoRims) {
  SurfaceMesh mesh = TubeMesh(12, 5, 2, 7);
  for (int i = 0; i < 12; ++i) mesh.vertices[static_cast<std::size_t>(48 + i)].head<2>() *= 1.5;
  const MeshTopology topology = FindMeshTopology(mesh);
  EXPECT_EQ(topology.euler_characteristic, 0);
  EXPECT_EQ(topology.genus, 0);
  ASSERT_EQ(topology.boundary_loops.size(), 2u);
  EXPECT_EQ(topology.boundary_loops[0][0], 48) << "the longest in space is not first";
  EXPECT_EQ(topology.boundary_loops[1].size(), 12u);
}

TEST(MeshTopology, SphereAndTorus_HaveTheirGenusAreaAndVolume) {
  const SurfaceMesh sphere = SphereMesh(120, 121, 3);
  MeshTopology topology = FindMeshTopology(sphere);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
  EXPECT_EQ(topology.euler_characteristic, 2);
  EXPECT_EQ(topology.genus, 0);
  EXPECT_NEAR(MeshVolume(sphere) / (36 * kPi), 1, 2e-3);
  EXPECT_NEAR(MeshArea(sphere) / (36 * kPi), 1, 2e-3);
  const SurfaceMesh torus = TorusMesh(200, 100, 5, 2);
  topology = FindMeshTopology(torus);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
  EXPECT_EQ(topology.euler_characteristic, 0);
  EXPECT_EQ(topology.genus, 1);
  EXPECT_NEAR(MeshVolume(torus) / (2 * kPi * kPi * 5 * 4), 1, 2e-3);
  EXPECT_NEAR(MeshArea(torus) / (4 * kPi * kPi * 10), 1, 2e-3);
}

TEST(MeshTopology, FarFromTheOrigin_VolumeKeepsItsDigits) {
  SurfaceMesh mesh = SphereMesh(40, 41, 3);
  const double volume = MeshVolume(mesh);
  for (auto& vertex : mesh.vertices) vertex += Eigen::Vector3d(4e6, 5e6, -1e6);
  EXPECT_NEAR(MeshVolume(mesh) / volume, 1, 1e-7);
}

TEST(MeshTopology, TwoComponents_AreCountedMostFacesFirst) {
  const MeshTopology topology = FindMeshTopology(Together(SphereMesh(6, 7, 1), TorusMesh(20, 10, 5, 2)));
  ASSERT_EQ(topology.components.size(), 2u);
  EXPECT_EQ(topology.components[0].genus, 1);
  EXPECT_EQ(topology.components[1].genus, 0);
  EXPECT_EQ(topology.components[1].euler_characteristic, 2);
  EXPECT_EQ(topology.euler_characteristic, 2);
  EXPECT_EQ(topology.genus, 1);
}

TEST(MeshTopology, TurnedFace_IsOrientableButNotOriented) {
  SurfaceMesh mesh = SphereMesh(8, 7, 1);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const MeshTopology topology = FindMeshTopology(mesh);
  EXPECT_FALSE(topology.oriented);
  EXPECT_TRUE(topology.orientable && topology.manifold && topology.closed);
  EXPECT_EQ(topology.genus, 0);
}

TEST(MeshTopology, MoebiusStrip_IsNotOrientableAndHasNoGenus) {
  SurfaceMesh mesh;
  for (int i = 0; i < 10; ++i) {
    const double angle = 2 * kPi * i / 10;
    for (const int side : {-1, 1}) {
      const double r = 3 + side * std::cos(angle / 2);
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2));
    }
  }
  for (int i = 0; i < 10; ++i) {
    const int a = 2 * i, b = a + 1, c = i < 9 ? a + 2 : 1, d = i < 9 ? a + 3 : 0;
    mesh.triangles.push_back({a, c, d});
    mesh.triangles.push_back({a, d, b});
  }
  const MeshTopology topology = FindMeshTopology(mesh);
  EXPECT_FALSE(topology.orientable);
  EXPECT_TRUE(topology.manifold);
  EXPECT_EQ(topology.genus, std::nullopt);
  EXPECT_EQ(topology.boundary_loops.size(), 1u);
  EXPECT_EQ(topology.boundary_loops[0].size(), 20u);
}

TEST(MeshTopology, ThirdFaceAtAnEdgeAndPinchedVertex_AreNotManifold) {
  SurfaceMesh mesh = SheetMesh(3, 2);
  mesh.vertices.emplace_back(1, 0.5, 1);
  mesh.triangles.push_back({1, 4, 6});  // 1-4 has two faces already
  MeshTopology topology = FindMeshTopology(mesh);
  EXPECT_EQ(topology.non_manifold_edges, 1);
  EXPECT_EQ(topology.non_manifold_vertices, 0);
  EXPECT_FALSE(topology.manifold || topology.oriented);
  EXPECT_EQ(topology.genus, std::nullopt);

  mesh = SheetMesh(3, 3);
  mesh.vertices.emplace_back(1, 1, 1);
  mesh.vertices.emplace_back(2, 1, 1);
  mesh.triangles.push_back({4, 9, 10});  // touches the sheet in its middle vertex alone
  topology = FindMeshTopology(mesh);
  EXPECT_EQ(topology.non_manifold_edges, 0);
  EXPECT_EQ(topology.non_manifold_vertices, 1);
  EXPECT_FALSE(topology.manifold);
}

TEST(MeshTopology, UnreferencedVertices_DoNotCount) {
  SurfaceMesh mesh = SphereMesh(8, 7, 1);
  mesh.vertices.insert(mesh.vertices.begin(), Eigen::Vector3d(9, 9, 9));
  for (auto& triangle : mesh.triangles)
    for (int& corner : triangle) ++corner;
  EXPECT_EQ(FindMeshTopology(mesh).euler_characteristic, 2);
  EXPECT_EQ(FindMeshTopology(mesh).components.size(), 1u);
}

TEST(MeshTopology, RenumberedMesh_HasTheSameAnswer) {
  const SurfaceMesh mesh = TubeMesh(30, 20, 2, 7);
  SurfaceMesh other = mesh;
  const int count = static_cast<int>(mesh.vertices.size());
  for (int v = 0; v < count; ++v)
    other.vertices[static_cast<std::size_t>(v * 7 % count)] = mesh.vertices[static_cast<std::size_t>(v)];
  for (auto& triangle : other.triangles)
    for (int& corner : triangle) corner = corner * 7 % count;
  std::reverse(other.triangles.begin(), other.triangles.end());
  const MeshTopology topology = FindMeshTopology(other);
  EXPECT_EQ(topology.boundary_loops.size(), 2u);
  EXPECT_EQ(topology.euler_characteristic, 0);
  EXPECT_EQ(topology.edges, FindMeshTopology(mesh).edges);
  EXPECT_NEAR(MeshArea(other), MeshArea(mesh), 1e-12 * MeshArea(mesh));
}

TEST(MeshTopology, MillionFaces_TakeLinearTime) {
  const SurfaceMesh mesh = TorusMesh(1000, 500, 5, 2);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(FindMeshTopology(mesh).genus, 1);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 2);
}

}  // namespace
}  // namespace frond
