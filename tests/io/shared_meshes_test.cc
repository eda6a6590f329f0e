// SPDX-License-Identifier: BSD-3-Clause
// Scanned meshes: their defects as found by hand, and what repair leaves.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "io/mesh_file.h"
#include "models/mesh_repair.h"
#include "models/mesh_topology.h"

namespace frond {
namespace {

struct Scan {
  const char* file;
  int duplicate_vertices, degenerate_faces;       // before
  int vertices, euler_characteristic, rim_edges;  // after
};

void PrintTo(const Scan& scan, std::ostream* out) { *out << scan.file; }

class SharedMesh : public ::testing::TestWithParam<Scan> {};

TEST_P(SharedMesh, AfterRepair_IsAManifoldWithTheKnownTopology) {
  const std::filesystem::path path = std::filesystem::path(FROND_SHARED_DATA) / "closed" / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data at " << path;
  const SurfaceMesh mesh = ReadMesh(path);
  const MeshDefects defects = FindMeshDefects(mesh);
  EXPECT_EQ(defects.duplicate_vertices, GetParam().duplicate_vertices);
  EXPECT_EQ(defects.degenerate_faces, GetParam().degenerate_faces);
  EXPECT_EQ(defects.duplicate_faces, 0);
  const SurfaceMesh repaired = RepairMesh(mesh);
  const MeshTopology topology = FindMeshTopology(repaired);
  EXPECT_TRUE(topology.manifold);
  EXPECT_TRUE(topology.oriented);
  EXPECT_EQ(topology.components.size(), 1u);
  EXPECT_EQ(topology.vertices, GetParam().vertices);
  EXPECT_EQ(topology.euler_characteristic, GetParam().euler_characteristic);
  EXPECT_EQ(topology.boundary_edges, GetParam().rim_edges);
  EXPECT_EQ(topology.boundary_loops.size(), GetParam().rim_edges > 0 ? 1u : 0u);
  EXPECT_TRUE(FindMeshDefects(repaired).none()) << FindMeshDefects(repaired).InWords();
  EXPECT_NEAR(MeshArea(repaired), MeshArea(mesh), 1e-6 * MeshArea(mesh));
}

// The pear has two flaps, whose tips go too.
INSTANTIATE_TEST_SUITE_P(Closed, SharedMesh,
                         ::testing::Values(Scan{"ycb_016_pear.obj", 2, 4, 8190, 2, 0},
                                           Scan{"ycb_013_apple.obj", 0, 0, 8194, 2, 0},
                                           Scan{"cgal_femur.off", 0, 0, 3897, -2, 0},
                                           Scan{"lv_mean_ED_endo.off", 56, 55, 785, 1, 28},
                                           Scan{"lv_mean_ED_epi.off", 56, 55, 785, 1, 28}),
                         [](const auto& info) {
                           const std::string name = info.param.file;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace frond
