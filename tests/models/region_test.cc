// SPDX-License-Identifier: BSD-3-Clause
#include "models/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/mesh_repair.h"
#include "models/mesh_topology.h"
#include "tests/models/example_meshes.h"

namespace frond {
namespace {

TEST(Region, OfNoHalfSpace_IsAllOfSpace) {
  const SurfaceMesh mesh = TorusMesh(12, 9, 5, 2);
  EXPECT_EQ(PointsInside({}, mesh.vertices), mesh.vertices);
  EXPECT_EQ(MeshInside({}, mesh).triangles, mesh.triangles);
}

TEST(Region, SlabOfASphere_IsATubeWithItsRimsOnThePlanes) {
  const std::vector<HalfSpace> slab = {{{0, 0, -0.52}, {0, 0, 3}}, {{7, 7, 0.45}, {0, 0, -0.1}}};
  const SurfaceMesh sphere = SphereMesh(48, 49, 1);
  const SurfaceMesh tube = MeshInside(slab, sphere);
  const MeshTopology topology = FindMeshTopology(tube);
  EXPECT_TRUE(topology.manifold);
  EXPECT_TRUE(topology.oriented);
  EXPECT_EQ(topology.euler_characteristic, 0);
  ASSERT_EQ(topology.boundary_loops.size(), 2u);
  EXPECT_TRUE(FindMeshDefects(tube).none()) << FindMeshDefects(tube).InWords();
  for (const auto& loop : topology.boundary_loops) {
    for (const int vertex : loop) {
      const double z = tube.vertices[static_cast<std::size_t>(vertex)].z();
      EXPECT_LT(std::min(std::abs(z + 0.52), std::abs(z - 0.45)), 1e-12);
    }
  }
  // What is kept comes first, in its order; all the rest lies on the planes.
  const std::vector<Eigen::Vector3d> kept = PointsInside(slab, sphere.vertices);
  ASSERT_GT(tube.vertices.size(), kept.size());
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), tube.vertices.begin()));
  for (const auto& vertex : tube.vertices) {
    EXPECT_GE(vertex.z(), -0.52 - 1e-12);
    EXPECT_LE(vertex.z(), 0.45 + 1e-12);
  }
}

TEST(Region, CutSphere_HasTheAreaOfItsZone) {
  // Archimedes: 2 pi r h; a mesh of 96 x 97 is smaller by 1 in 1500.
  const SurfaceMesh sphere = SphereMesh(96, 97, 2);
  for (const double height : {-1.3, -0.2, 0.0, 0.777, 1.5}) {
    const HalfSpace half{{5, 0, height}, {0, 0, 2}};
    const double area = MeshArea(MeshInside({&half, 1}, sphere)),
                 zone = 2 * std::numbers::pi * 2 * (2 - height);
    EXPECT_NEAR(area, zone, 2e-3 * zone) << height;
    // Both sides of a cut make the whole, to rounding.
    const HalfSpace other{half.point, -half.normal};
    EXPECT_NEAR(area + MeshArea(MeshInside({&other, 1}, sphere)), MeshArea(sphere), 1e-12 * MeshArea(sphere));
  }
}

TEST(Region, PlaneThroughVertices_AddsNoneAndLeavesNoSliver) {
  const SurfaceMesh sheet = SheetMesh(11, 5);
  const HalfSpace half{{4, 0, 0}, {1, 0, 0}};
  const SurfaceMesh right = MeshInside({&half, 1}, sheet);
  EXPECT_EQ(right.vertices.size(), 7u * 5);
  EXPECT_EQ(right.triangles.size(), 2u * 6 * 4);
  EXPECT_TRUE(FindMeshDefects(right).none());
}

TEST(Region, ObliqueCut_PutsItsNewVerticesOnThePlane) {
  const SurfaceMesh torus = TorusMesh(60, 30, 5, 2);
  const HalfSpace half{{0.3, 0.2, 0.1}, Eigen::Vector3d(1, -2, 0.5)};
  const SurfaceMesh part = MeshInside({&half, 1}, torus);
  const std::size_t kept = PointsInside({&half, 1}, torus.vertices).size();
  ASSERT_GT(part.vertices.size(), kept + 20);
  for (std::size_t k = kept; k < part.vertices.size(); ++k) {
    EXPECT_LT(std::abs(half.normal.normalized().dot(part.vertices[k] - half.point)), 1e-12);
  }
  EXPECT_TRUE(FindMeshTopology(part).manifold);
}

TEST(Region, CutThroughManyFaces_LeavesAManifoldInOnePart) {
  const SurfaceMesh sphere = SphereMesh(40, 41, 1);
  for (int k = 0; k < 200; ++k) {
    const HalfSpace half{{0, 0, -0.9 + 0.005 * k}, {std::sin(0.37 * k), std::cos(0.53 * k), 0.4}};
    const MeshTopology topology = FindMeshTopology(MeshInside({&half, 1}, sphere));
    EXPECT_TRUE(topology.manifold);
    EXPECT_EQ(topology.components.size(), 1u) << k;
    EXPECT_EQ(topology.boundary_loops.size(), 1u) << k;
  }
}

TEST(Region, PointOnThePlane_IsInside) {
  const std::vector<HalfSpace> half = {{{1, 2, 3}, {0, 1, 0}}};
  EXPECT_TRUE(IsInside(half, {9, 2, -4}));
  EXPECT_FALSE(IsInside(half, {9, 1.999, -4}));
}

}  // namespace
}  // namespace frond
