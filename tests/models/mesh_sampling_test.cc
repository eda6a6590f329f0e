// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_sampling.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/models/example_meshes.h"

namespace frond {
namespace {

TEST(SampleMesh, OfUnevenFaces_IsUniformByArea) {
  // A unit square in two triangles and one of 3 × 1 in two: a quarter of the points on the first.
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {4, 0, 0}, {4, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  Random random(3);
  const auto points = SampleMesh(mesh, 40000, &random);
  ASSERT_EQ(points.size(), 40000u);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double square = 0;
  for (const auto& p : points) {
    EXPECT_TRUE(p.x() >= 0 && p.x() <= 4 && p.y() >= 0 && p.y() <= 1 && p.z() == 0);
    mean += p / 40000;
    square += p.x() * p.x() / 40000;
  }
  EXPECT_NEAR(mean.x(), 2, 0.03);
  EXPECT_NEAR(mean.y(), 0.5, 0.008);
  EXPECT_NEAR(square, 16.0 / 3, 0.15);
}

TEST(SampleMesh, SameSeed_SamePoints) {
  const SurfaceMesh mesh = TorusMesh(12, 9, 5, 2);
  Random one(7), other(7);
  EXPECT_EQ(SampleMesh(mesh, 100, &one), SampleMesh(mesh, 100, &other));
}

}  // namespace
}  // namespace frond
