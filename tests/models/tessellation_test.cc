// SPDX-License-Identifier: BSD-3-Clause
#include "models/tessellation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <map>
#include <set>

#include "base/errors.h"
#include "models/surface_integrals.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

double TriangleArea(const SurfaceMesh& mesh, const std::array<int, 3>& t) {
  const auto& p = mesh.vertices;
  return (p[At(t[1])] - p[At(t[0])]).cross(p[At(t[2])] - p[At(t[0])]).norm() / 2;
}

double MeshArea(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += TriangleArea(mesh, t);
  return sum;
}

// Each directed edge once; its opposite is missing on the boundary.
std::vector<std::array<int, 2>> BoundaryEdges(const SurfaceMesh& mesh) {
  std::set<std::array<int, 2>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second)
          << "an edge belongs to three triangles or is turned";
    }
  }
  std::vector<std::array<int, 2>> boundary;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) boundary.push_back({a, b});
  }
  return boundary;
}

// Edges between two triangles at most, one fan of triangles at every vertex, every vertex used, unit normals.
void ExpectManifold(const SurfaceMesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), mesh.normals.size());
  ASSERT_EQ(mesh.vertices.size(), mesh.parameters.size());
  std::map<int, int> boundary_starts;
  for (const auto& [a, b] : BoundaryEdges(mesh)) ++boundary_starts[a];
  for (const auto& [vertex, times] : boundary_starts) EXPECT_EQ(times, 1) << "the boundary pinches a vertex";
  std::vector<char> used(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (const int vertex : t) used[At(vertex)] = 1;
    EXPECT_GT(TriangleArea(mesh, t), 0);
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    EXPECT_TRUE(used[k]);
    EXPECT_NEAR(mesh.normals[k].norm(), 1, 1e-12);
  }
}

long EulerNumber(const SurfaceMesh& mesh) {
  const auto boundary = static_cast<long>(BoundaryEdges(mesh).size());
  const auto triangles = static_cast<long>(mesh.triangles.size());
  return static_cast<long>(mesh.vertices.size()) - (3 * triangles + boundary) / 2 + triangles;
}

double ParameterArea(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.parameters[At(t[0])], &b = mesh.parameters[At(t[1])], &c = mesh.parameters[At(t[2])];
    const double twice = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    EXPECT_GT(twice, 0);
    sum += twice / 2;
  }
  return sum;
}

double BoundaryLength(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b] : BoundaryEdges(mesh))
    sum += (mesh.parameters[At(a)] - mesh.parameters[At(b)]).norm();
  return sum;
}

double LoopArea(const TrimLoop& loop) {
  double twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2d &a = loop[k], &b = loop[(k + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

double LoopLength(const TrimLoop& loop) {
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) sum += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  return sum;
}

// The mesh covers the inside of the loops once and its boundary is the loops: no crack, no T-junction.
void ExpectFills(const SurfaceMesh& mesh, const TrimLoop& outer, const std::vector<TrimLoop>& holes = {}) {
  double area = LoopArea(outer), length = LoopLength(outer);
  for (const TrimLoop& hole : holes) {
    area -= LoopArea(hole);
    length += LoopLength(hole);
  }
  ExpectManifold(mesh);
  EXPECT_NEAR(ParameterArea(mesh), area, 1e-12);
  EXPECT_NEAR(BoundaryLength(mesh), length, 1e-10);
  EXPECT_EQ(EulerNumber(mesh), 1 - static_cast<long>(holes.size()));
}

TEST(Tessellate, UntrimmedPlane_IsAGrid) {
  const SurfaceMesh mesh = Tessellate({PlaneSurface(3, 6), {}}, 4);
  EXPECT_EQ(mesh.vertices.size(), 13u * 13u);
  EXPECT_EQ(mesh.triangles.size(), 2u * 12u * 12u);
  ExpectFills(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

TEST(Tessellate, ToothedLoops_AreFilledOnEveryGrid) {
  Random random(61);
  for (int trial = 0; trial < 60; ++trial) {
    const TrimLoop outer = ToothedLoop({0.5, 0.5}, 0.49, 3 + static_cast<int>(random.Below(600)), random);
    const int count = 4 + static_cast<int>(random.Below(12)),
              segments = 1 + static_cast<int>(random.Below(5));
    SCOPED_TRACE("trial " + std::to_string(trial));
    ExpectFills(Tessellate({PlaneSurface(3, count), {outer}}, segments), outer);
  }
}

TEST(Tessellate, Holes_SmallerAndLargerThanCells_AreLeftOut) {
  Random random(62);
  for (int trial = 0; trial < 30; ++trial) {
    const TrimLoop outer = RegularLoop({0.5, 0.5}, 0.49, 101);
    std::vector<TrimLoop> holes;
    for (const Eigen::Vector2d& centre : {Eigen::Vector2d(0.3, 0.4), {0.7, 0.45}, {0.5, 0.75}, {0.52, 0.3}}) {
      holes.push_back(
          ToothedLoop(centre, random.Uniform(0.005, 0.12), 3 + static_cast<int>(random.Below(60)), random));
    }
    if (trial % 2 == 0) std::reverse(holes[0].begin(), holes[0].end());
    std::vector<TrimLoop> trim{outer};
    trim.insert(trim.end(), holes.begin(), holes.end());
    SCOPED_TRACE("trial " + std::to_string(trial));
    ExpectFills(Tessellate({PlaneSurface(2, 3 + trial % 9), trim}, 1 + trial % 3), outer, holes);
  }
}

TEST(Tessellate, LoopsAlongGridLinesAndThroughNodes_AreFilled) {
  const NurbsSurface plane = PlaneSurface(1, 5);  // lines at quarters
  const TrimLoop square = {{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  const TrimLoop diamond = {{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}};
  const TrimLoop steps = {{0, 0},     {0.5, 0},    {0.5, 0.25}, {0.6, 0.25},
                          {0.6, 0.5}, {0.25, 0.5}, {0.25, 1},   {0, 1}};
  for (const TrimLoop& loop : {square, diamond, steps}) ExpectFills(Tessellate({plane, {loop}}, 1), loop);
  const TrimLoop whole = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  ExpectFills(Tessellate({plane, {whole, square}}, 1), whole, {square});
  ExpectFills(Tessellate({plane, {whole, square}}, 3), whole, {square});
}

TEST(Tessellate, LoopThatRunsBackAndForthOnTheDomainsEdge_IsFilled) {
  const TrimLoop loop = {{0, 0.1}, {0.7, 0.2}, {0.9, 0.8}, {0, 0.9},
                         {0, 0.5}, {0, 0.62},  {0, 0.4},   {0, 0.45}};
  const TrimLoop plain = {{0, 0.1}, {0.7, 0.2}, {0.9, 0.8}, {0, 0.9}};
  ExpectFills(Tessellate({PlaneSurface(3, 8), {loop}}, 2), plain);
}

TEST(Tessellate, LoopsOfALattice_WithManyCoincidences_AreFilled) {
  // Corners and edges fall on grid lines all the time.
  Random random(63);
  for (int trial = 0; trial < 100; ++trial) {
    TrimLoop loop;
    for (int k = 0; k < 16; ++k) {
      const double angle = 2 * kPi * k / 16, r = random.Uniform(0.15, 0.5);
      const Eigen::Vector2d exact =
          Eigen::Vector2d(0.5, 0.5) + r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      loop.push_back({std::round(exact.x() * 32) / 32, std::round(exact.y() * 32) / 32});
    }
    SCOPED_TRACE("trial " + std::to_string(trial));
    ExpectManifold(Tessellate({PlaneSurface(1, 17), {loop}}, 1));
    EXPECT_NEAR(ParameterArea(Tessellate({PlaneSurface(1, 17), {loop}}, 1)), LoopArea(loop), 1e-13);
  }
}

TEST(Tessellate, Sphere_HasPolesWithoutEmptyTriangles) {
  const SurfaceMesh mesh = Tessellate({ExactSphere(2), {}}, 8);
  ExpectManifold(mesh);
  int poles = 0;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    if (std::abs(mesh.vertices[k].z()) < 2 - 1e-9) continue;
    ++poles;
    EXPECT_GT(mesh.normals[k].dot(mesh.vertices[k]) / 2, 0.999);
  }
  EXPECT_EQ(poles, 2);
}

TEST(Tessellate, SphereArea_ConvergesWithTheSquareOfTheCells) {
  const double coarse = 16 * kPi - MeshArea(Tessellate({ExactSphere(2), {}}, 8));
  const double fine = 16 * kPi - MeshArea(Tessellate({ExactSphere(2), {}}, 16));
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

TEST(Tessellate, PeriodicTubeAndTorus_AreClosed) {
  std::vector<Eigen::Vector3d> tube, torus;
  const int n = 4;
  for (int i = 0; i < n + 3; ++i) {
    const double a = 2 * kPi * i / n;
    for (int j = 0; j < 2; ++j) tube.emplace_back(std::cos(a), std::sin(a), j);
    for (int j = 0; j < n + 3; ++j) {
      const double b = 2 * kPi * j / n, r = 3 + std::cos(b);
      torus.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
    }
  }
  const BSplineBasis around = PeriodicUniformBasis(3, n);
  const SurfaceMesh tube_mesh = Tessellate({NurbsSurface(around, UniformBasis(1, 2), tube), {}}, 3);
  ExpectManifold(tube_mesh);
  EXPECT_EQ(EulerNumber(tube_mesh), 0);
  EXPECT_EQ(BoundaryEdges(tube_mesh).size(), 24u);
  const SurfaceMesh torus_mesh = Tessellate({NurbsSurface(around, around, torus), {}}, 1);
  ExpectManifold(torus_mesh);
  EXPECT_EQ(EulerNumber(torus_mesh), 0);
  EXPECT_TRUE(BoundaryEdges(torus_mesh).empty());
}

TEST(Tessellate, PeriodicTubeCutByALoopOverTheSeam_IsClosedThere) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 4; ++j) points.emplace_back(std::cos(kPi * i / 3), std::sin(kPi * i / 3), j);
  }
  const NurbsSurface tube(PeriodicUniformBasis(3, 6), UniformBasis(3, 4), points);
  TrimLoop loop = {{0, 0.1}};  // up the seam on one side with other corners than on the other side
  for (int k = 1; k < 40; ++k) loop.push_back({k / 40.0, 0.15 + 0.05 * std::sin(k)});
  loop.insert(loop.end(), {{1, 0.1}, {1, 0.33}, {1, 0.8}, {0.5, 0.7}, {0, 0.8}, {0, 0.61}});
  const SurfaceMesh mesh = Tessellate({tube, {loop}}, 2);
  ExpectManifold(mesh);
  EXPECT_EQ(EulerNumber(mesh), 0);
  for (const auto& [a, b] : BoundaryEdges(mesh)) {
    EXPECT_FALSE(mesh.parameters[At(a)].x() == 0 && mesh.parameters[At(b)].x() == 0);
  }
}

TEST(Tessellate, LeafWithACollapsedTip_TrimmedOverIt_IsManifold) {
  const BSplineBasis u = UniformBasis(3, 6), v = UniformBasis(3, 8);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 8; ++j) points.emplace_back((i - 2.5) * (7 - j) / 7.0, j, 0.1 * i * (7 - j));
  }
  const NurbsSurface leaf(u, v, points);
  ExpectManifold(Tessellate({leaf, {}}, 3));
  const TrimLoop loop = {{0.1, 0.1}, {0.8, 0.1}, {0.9, 1}, {0.6, 1}, {0.5, 0.9}, {0.4, 1}, {0.2, 1}};
  const SurfaceMesh mesh = Tessellate({leaf, {loop}}, 3);  // touches the tip twice
  ExpectManifold(mesh);
  EXPECT_NEAR(MeshArea(mesh) / Area({leaf, {loop}}), 1, 0.01);
}

TEST(Tessellate, TrimmedCurvedSurface_HasTheAreaOfTheIntegral) {
  Random random(64);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 12), UniformBasis(3, 12), random);
  const TrimmedSurface trimmed{s, {ToothedLoop({0.5, 0.5}, 0.45, 500, random)}};
  const double area = Area(trimmed);
  EXPECT_NEAR(MeshArea(Tessellate(trimmed, 4)) / area, 1, 1e-2);
  EXPECT_NEAR(MeshArea(Tessellate(trimmed, 16)) / area, 1, 7e-4);
}

TEST(Tessellate, FortyCellsAnd1000Corners_TakesMilliseconds) {
  Random random(65);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 23), UniformBasis(3, 23), random);
  const TrimmedSurface trimmed{s, {ToothedLoop({0.5, 0.5}, 0.48, 1000, random)}};
  const auto start = std::chrono::steady_clock::now();
  const SurfaceMesh mesh = Tessellate(trimmed, 2);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  RecordProperty("milliseconds", std::to_string(elapsed.count()));
  std::printf("  %zu triangles: %.1f ms\n", mesh.triangles.size(), elapsed.count());
}

TEST(Tessellate, BadInput_IsRefusedByName) {
  EXPECT_EQ(MessageOf<InputError>([] {
              Tessellate({PlaneSurface(1, 2), {}}, 0);
            }),
            "segments per span must be at least 1, not 0");
  const TrimLoop loop = {{0, 0}, {1.5, 0}, {1, 1}};
  EXPECT_EQ(MessageOf<InputError>([&] {
              Tessellate({PlaneSurface(1, 2), {loop}}, 1);
            }),
            "trim loop point (1.500000, 0.000000) is outside the surface's domain");
}

}  // namespace
}  // namespace frond
