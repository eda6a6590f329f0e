// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "tests/models/example_meshes.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

TEST(NearestOnTriangle, InEachRegion_IsTheFaceEdgeOrCorner) {
  const Eigen::Vector3d a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  const auto expect = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& nearest) {
    EXPECT_LT((NearestOnTriangle(p, a, b, c) - nearest).norm(), 1e-14) << p.transpose();
    EXPECT_LT((NearestOnTriangle(p, c, b, a) - nearest).norm(), 1e-14) << p.transpose();
  };
  expect({1, 1, 5}, {1, 1, 0});   // the face
  expect({2, -3, 1}, {2, 0, 0});  // its edges
  expect({-2, 1, -1}, {0, 1, 0});
  expect({2 + 3, 1.5 + 4, 7}, {2, 1.5, 0});
  expect({-1, -2, 3}, a);  // its corners
  expect({9, -1, 0}, b);
  expect({-1, 8, 0}, c);
  expect({0, 0, 0}, a);
}

TEST(NearestOnTriangle, WithoutArea_IsOnItsLongestSide) {
  const Eigen::Vector3d nearest = NearestOnTriangle({1, 2, 0}, {0, 0, 0}, {3, 0, 0}, {1.5, 0, 0});
  EXPECT_LT((nearest - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(NearestOnTriangle({1, 2, 3}, {4, 4, 4}, {4, 4, 4}, {4, 4, 4}), Eigen::Vector3d(4, 4, 4));
}

TEST(NearestOnTriangle, OfRandomTriangles_IsNearerThanAllSamples) {
  Random random(8);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d a = RandomVector(random), b = RandomVector(random), c = RandomVector(random),
                          p = 2 * RandomVector(random);
    const double distance = (NearestOnTriangle(p, a, b, c) - p).norm();
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 60; ++i) {
      for (int j = 0; i + j <= 60; ++j) {
        least = std::min(least, (a + (i * (b - a) + j * (c - a)) / 60.0 - p).norm());
      }
    }
    EXPECT_LE(distance, least + 1e-14);
    EXPECT_GE(distance, least - 0.05);
  }
}

TEST(MeshDistance, OfRandomPoints_IsTheLeastOfAllFaces) {
  const SurfaceMesh mesh = Together(TorusMesh(30, 14, 5, 2), SphereMesh(9, 7, 1));
  const MeshDistance distance(mesh);
  Random random(9);
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector3d p = 8 * RandomVector(random);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto at = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
      least = std::min(least, (NearestOnTriangle(p, at(a), at(b), at(c)) - p).norm());
    }
    EXPECT_EQ(distance(p), least);
  }
}

TEST(MeshDistance, OfAPointOfTheMesh_IsZero) {
  const SurfaceMesh mesh = TorusMesh(30, 14, 5, 2);
  const MeshDistance distance(mesh);
  for (const auto& vertex : mesh.vertices) EXPECT_LT(distance(vertex), 1e-14);
}

TEST(MeshDistance, ToASingleTriangle_IsThatOfIt) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_DOUBLE_EQ(MeshDistance(mesh)({1, 1, 5}), 5);
}

}  // namespace
}  // namespace frond
