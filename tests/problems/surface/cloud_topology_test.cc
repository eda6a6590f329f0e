// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/cloud_topology.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <numbers>
#include <ostream>

#include "base/errors.h"
#include "io/mesh_file.h"
#include "io/point_cloud_file.h"
#include "models/mesh_repair.h"
#include "models/mesh_sampling.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/wrapping.h"
#include "tests/models/example_meshes.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;
using Points = std::vector<Eigen::Vector3d>;

Points Sampled(const SurfaceMesh& mesh, std::size_t count, double noise = 0, std::uint64_t seed = 1) {
  Random random(seed);
  Points points = SampleMesh(mesh, count, &random);
  for (auto& point : points) {
    for (Eigen::Index k = 0; k < 3; ++k) point[k] += noise * random.Normal();
  }
  return points;
}

TopologyFinding OfMesh(const SurfaceMesh& mesh) { return FindSurfaceTopology(mesh, FindMeshTopology(mesh)); }

std::string NameOf(const TopologyFinding& finding) {
  return finding.topology ? SurfaceTopologyName(*finding.topology) : "none";
}

// A part of a cylinder's side.
SurfaceMesh RolledSheet(double turn) {
  return GridMesh(60, 30, false, false, [=](int i, int j) {
    const double angle = 2 * kPi * turn * i / 59;
    return Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 9 * j / 29.0);
  });
}

SurfaceMesh Shifted(SurfaceMesh mesh, const Eigen::Vector3d& by) {
  for (auto& vertex : mesh.vertices) vertex += by;
  return mesh;
}

struct Shape {
  const char* name;
  SurfaceMesh mesh;
  const char* topology;
};

std::vector<Shape> Shapes() {
  return {
      {"sheet", SheetMesh(30, 20), "sheet"},
      {"sphere", SphereMesh(60, 31, 2), "sphere"},
      {"tube", TubeMesh(60, 30, 2, 7), "tube"},
      {"long tube", TubeMesh(60, 30, 1, 30), "tube"},
      {"ring", TubeMesh(60, 30, 3, 1), "tube"},
      {"dish", SphereMesh(60, 31, 2, 0.4 * kPi), "sheet"},
      {"bowl", SphereMesh(60, 31, 2, 0.5 * kPi), "cup"},
      {"vase", SphereMesh(60, 31, 2, 0.8 * kPi), "cup"},
      {"half rolled", RolledSheet(0.5), "sheet"},
      {"rolled", RolledSheet(0.85), "sheet"},
      {"torus", TorusMesh(100, 60, 5, 2), "none"},
      {"two spheres", Together(SphereMesh(40, 21, 2), Shifted(SphereMesh(40, 21, 2), {8, 0, 0})), "none"}};
}

TEST(CloudTopology, OfSampledShapes_IsTheirs) {
  for (const Shape& shape : Shapes()) {
    for (const std::size_t count : {1500u, 5000u}) {
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const TopologyFinding finding = FindSurfaceTopology(Sampled(shape.mesh, count, 0.01, seed));
        EXPECT_EQ(NameOf(finding), shape.topology) << shape.name << ", " << count << ": " << finding.message;
      }
    }
  }
}

TEST(MeshSurfaceTopology, OfTheSameShapes_IsTheSame) {
  for (const Shape& shape : Shapes()) {
    const TopologyFinding finding = OfMesh(shape.mesh);
    EXPECT_EQ(NameOf(finding), shape.topology) << shape.name << ": " << finding.message;
    EXPECT_TRUE(finding.exact);
  }
}

TEST(CloudTopology, OfATorus_CountsItsHandle) {
  for (const TopologyFinding& finding :
       {FindSurfaceTopology(Sampled(TorusMesh(100, 60, 5, 2), 5000)), OfMesh(TorusMesh(100, 60, 5, 2))}) {
    EXPECT_EQ(finding.components, 1);
    EXPECT_EQ(finding.loops, 2);
    EXPECT_EQ(finding.cavities, 1);
    EXPECT_EQ(finding.genus, 1);
    EXPECT_NE(
        finding.message.find("closed with genus 1 (one handle): frond fits sheets, tubes, cups and spheres"),
        std::string::npos);
  }
}

TEST(CloudTopology, OfTwoSpheres_IsRefusedAsParts) {
  const SurfaceMesh both = Together(SphereMesh(40, 21, 2), Shifted(SphereMesh(40, 21, 2), {8, 0, 0}));
  for (const TopologyFinding& finding : {FindSurfaceTopology(Sampled(both, 5000)), OfMesh(both)}) {
    EXPECT_EQ(finding.components, 2);
    EXPECT_NE(finding.message.find("falls into 2 parts"), std::string::npos);
  }
}

TEST(CloudTopology, TurnedMovedScaledAndReordered_IsTheSame) {
  Points points = Sampled(TubeMesh(60, 30, 2, 7), 3000);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (auto& point : points) point = 1e-3 * (turn * point) + Eigen::Vector3d(40, -7, 12);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(NameOf(FindSurfaceTopology(points)), "tube");
}

TEST(CloudTopology, HolesInASheetAndStrays_DoNotMatter) {
  Points points;
  for (const auto& point : Sampled(SheetMesh(60, 40), 9000, 0.02)) {
    const bool eaten =
        (point - Eigen::Vector3d(15, 20, 0)).norm() < 5 || (point - Eigen::Vector3d(40, 25, 0)).norm() < 7;
    if (!eaten) points.push_back(point);
  }
  Random random(4);
  for (int k = 0; k < 100; ++k)
    points.emplace_back(random.Uniform(0, 60), random.Uniform(0, 40), random.Uniform(-30, 30));
  const TopologyFinding finding = FindSurfaceTopology(points);
  EXPECT_EQ(NameOf(finding), "sheet");
  EXPECT_EQ(finding.loops, 2);
  EXPECT_EQ(finding.message, "the cloud is an open sheet with two holes");
}

TEST(CloudTopology, UnevenSampling_IsBorne) {
  Random random(2);
  Points points;
  for (const auto& point : Sampled(SphereMesh(80, 41, 2), 20000)) {
    if (random.Uniform() < (point.z() > 0 ? 1 : 0.15)) points.push_back(point);
  }
  EXPECT_EQ(NameOf(FindSurfaceTopology(points)), "sphere");
}

TEST(CloudTopology, SyntheticLeaves_AreSheets) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    LeafScanOptions options;
    options.seed = seed;
    options.points = 4000;
    options.dense_points = 1000;
    options.random_pose = true;
    if (seed % 2 == 0) {
      options.outlier_share = 0.04;
      options.holes = 3;
      options.petiole_length = 15;
      options.missing_tip = 0.1;
    }
    LeafShape shape = RandomLeaf(seed);
    if (seed > 4) shape.curl_angle = 119;
    const TopologyFinding finding = FindSurfaceTopology(ScanLeaf(shape, options).points);
    EXPECT_EQ(NameOf(finding), "sheet") << seed << ": " << finding.message;
  }
}

TEST(CloudTopology, FewOrCoincidentPoints_AreInputErrors) {
  EXPECT_THROW(FindSurfaceTopology(Points(9, Eigen::Vector3d::Zero())), InputError);
  EXPECT_THROW(FindSurfaceTopology(Points(50, Eigen::Vector3d(1, 2, 3))), InputError);
}

TEST(MeshSurfaceTopology, MeshesThatAreNoSurface_SayWhy) {
  SurfaceMesh mesh = SheetMesh(3, 2);
  mesh.vertices.emplace_back(1, 0.5, 1);
  mesh.triangles.push_back({1, 4, 6});
  EXPECT_EQ(
      OfMesh(mesh).message,
      "the mesh is not a manifold (edges with more than two faces: 1, vertices where faces only touch: 0): "
      "set input.repair to true");
  mesh = TorusMesh(30, 20, 5, 2);
  mesh.triangles.resize(mesh.triangles.size() - 8);
  const TopologyFinding finding = OfMesh(mesh);
  EXPECT_EQ(finding.topology, std::nullopt);
  EXPECT_EQ(finding.message.find("the mesh is open with genus 1 (one handle)"), 0u);
}

TEST(MeshSurfaceTopology, PinholeInACup_DoesNotMakeItATube) {
  SurfaceMesh mesh = SphereMesh(60, 31, 2, 0.7 * kPi);
  mesh.triangles.erase(mesh.triangles.begin() + 900);
  EXPECT_EQ(NameOf(OfMesh(mesh)), "cup");
}

TEST(ChooseTopology, MeshOfAnotherKindThanAsked_IsAFitError) {
  const TopologyFinding cup = OfMesh(SphereMesh(60, 31, 2, 0.7 * kPi)),
                        sphere = OfMesh(SphereMesh(60, 31, 2)), tube = OfMesh(TubeMesh(60, 30, 2, 7)),
                        torus = OfMesh(TorusMesh(100, 60, 5, 2));
  EXPECT_EQ(ChooseTopology(cup, {}), SurfaceTopology::kCup);
  EXPECT_EQ(ChooseTopology(cup, SurfaceTopology::kSheet), SurfaceTopology::kSheet);
  EXPECT_EQ(ChooseTopology(tube, SurfaceTopology::kTube), SurfaceTopology::kTube);
  EXPECT_THROW(ChooseTopology(cup, SurfaceTopology::kTube), FitError);
  EXPECT_THROW(ChooseTopology(sphere, SurfaceTopology::kCup), FitError);
  EXPECT_THROW(ChooseTopology(tube, SurfaceTopology::kSheet), FitError);
  EXPECT_THROW(ChooseTopology(tube, SurfaceTopology::kCup), FitError);
  EXPECT_THROW(ChooseTopology(torus, {}), FitError);
  EXPECT_THROW(ChooseTopology(torus, SurfaceTopology::kSphere), FitError);
  try {
    ChooseTopology(cup, SurfaceTopology::kSphere);
    ADD_FAILURE() << "an open mesh passed for a closed one";
  } catch (const FitError& error) {
    EXPECT_STREQ(error.what(),
                 "problem.topology is 'sphere', but the mesh is a cup: open at one rim: set it to 'auto', or "
                 "cut a part out with input.region");
  }
}

TEST(ChooseTopology, OfACloud_IsWhatTheUserSays) {
  TopologyFinding cloud;
  cloud.topology = SurfaceTopology::kSheet;
  EXPECT_EQ(ChooseTopology(cloud, {}), SurfaceTopology::kSheet);
  EXPECT_EQ(ChooseTopology(cloud, SurfaceTopology::kSphere), SurfaceTopology::kSphere);
}

TEST(Wrapping, OfAHemisphere_IsRingsProjectedToAHalf) {
  const Wrapping wrapping = FindWrapping(Sampled(SphereMesh(80, 81, 1, kPi / 2), 8000), 0.08);
  EXPECT_NEAR(std::abs(wrapping.axis.z()), 1, 0.02);
  EXPECT_GE(wrapping.ring_share, 0.75);  // all but the slab of the pole and broken rings
  EXPECT_NEAR(wrapping.evenness, 1, 0.1);
  EXPECT_NEAR(wrapping.projected, 0.5, 0.02);
}

TEST(Wrapping, OfFlattenedTubesAndBoats_TellsThemApart) {
  SurfaceMesh tube = TubeMesh(80, 60, 1, 9);
  for (auto& vertex : tube.vertices) vertex.x() *= 4;
  EXPECT_EQ(NameOf(FindSurfaceTopology(Sampled(tube, 5000))), "tube");
  // A trough with closed ends, ten times as long as wide, is a bent sheet.
  SurfaceMesh boat = SphereMesh(80, 60, 1, 0.5 * kPi);
  for (auto& vertex : boat.vertices) vertex.x() *= 10;
  EXPECT_EQ(NameOf(FindSurfaceTopology(Sampled(boat, 5000))), "sheet");
}

struct Scan {
  const char* file;
  const char* mesh;   // by its faces
  const char* cloud;  // by its points alone
};

void PrintTo(const Scan& scan, std::ostream* out) { *out << scan.file; }

class SharedScan : public ::testing::TestWithParam<Scan> {};

TEST_P(SharedScan, HasTheKnownTopology) {
  const std::filesystem::path path = std::filesystem::path(FROND_SHARED_DATA) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data at " << path;
  const std::string cloud = GetParam().cloud, kind = GetParam().mesh;
  if (!cloud.empty()) {
    EXPECT_EQ(NameOf(FindSurfaceTopology(ReadPointCloud(path).points)), cloud);
  }
  if (kind.empty()) return;
  const SurfaceMesh mesh = RepairMesh(ReadMesh(path));
  const TopologyFinding finding = OfMesh(mesh);
  EXPECT_EQ(NameOf(finding), kind) << finding.message;
  if (cloud.empty()) return;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex);
  const Points sampled = Sampled(mesh, 50000, 5e-4 * box.sizes().maxCoeff());
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(NameOf(FindSurfaceTopology(sampled)), cloud);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(seconds.count(), 1.5) << "0.2 to 0.3 s on an idle core";
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedScan,
    ::testing::Values(Scan{"closed/ycb_016_pear.obj", "sphere", "sphere"},
                      Scan{"closed/ycb_013_apple.obj", "sphere", "sphere"},
                      Scan{"closed/lv_mean_ED_endo.off", "cup", "cup"},
                      Scan{"closed/lv_mean_ED_epi.off", "cup", "cup"},
                      Scan{"closed/cgal_femur.off", "none", ""}, Scan{"closed/pcl_bun0.pcd", "", "sheet"},
                      Scan{"leaf/soybean_11_20190508T043118_pot1_15.txt", "", "sheet"},
                      Scan{"leaf/soybean_11_20190508T043118_pot1_17.txt", "", "sheet"},
                      Scan{"leaf/sugarbeet_f00012_20170904T033001_pot2_1.txt", "", "sheet"},
                      Scan{"leaf/sugarbeet_f00012_20170904T115033_pot1_7.txt", "", "sheet"}),
    [](const auto& info) {
      const std::string name = std::filesystem::path(info.param.file).stem().string();
      return name;
    });

TEST(SharedFemur, IsRefusedWithItsGenusInWords) {
  const std::filesystem::path path = std::filesystem::path(FROND_SHARED_DATA) / "closed/cgal_femur.off";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data at " << path;
  const TopologyFinding finding = OfMesh(ReadMesh(path));
  EXPECT_EQ(finding.genus, 2);
  EXPECT_EQ(
      finding.message.find("the mesh is closed with genus 2 (two handles): frond fits sheets, tubes, cups "
                           "and spheres; cut a part out with input.region, for example "),
      0u);
}

}  // namespace
}  // namespace frond
