// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frond {
namespace {

// Rings of a unit sphere, 0.1 apart.
std::vector<Eigen::Vector3d> Sphere() {
  std::vector<Eigen::Vector3d> points;
  for (int j = 1; j < 31; ++j) {
    const double polar = std::numbers::pi * j / 31;
    const int count = static_cast<int>(62 * std::sin(polar)) + 4;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      points.emplace_back(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                          std::cos(polar));
    }
  }
  return points;
}

TEST(SectionPoints, PointsBesideThePlane_MoveAlongTheSurfaceIntoIt) {
  const std::vector<Eigen::Vector3d> points = Sphere();
  const KdTree tree(points);
  SectionPlane plane;
  plane.origin = {0, 0, 0.6};  // the surface is inclined by 53 degrees here: straight projection is .06 off
  const std::vector<Eigen::Vector3d> section = SectionPoints(points, tree, plane, 0.1, 0.4);
  ASSERT_GT(section.size(), 60U);
  for (const auto& point : section) {
    EXPECT_NEAR(point.z(), 0.6, 1e-12);
    EXPECT_NEAR(point.head<2>().norm(), 0.8, 1e-3);
  }
  EXPECT_LT((SectionCentroid(section, plane) - plane.origin).norm(), 2e-3);
}

TEST(SectionPoints, PlaneThatCutsTwoParts_TakesTheOneNearItsOrigin) {
  std::vector<Eigen::Vector3d> points = Sphere();
  for (const auto& point : Sphere()) points.push_back(point + Eigen::Vector3d(3, 0, 0));
  const KdTree tree(points);
  SectionPlane plane;
  plane.origin = {2.9, 0, 0};
  for (const auto& point : SectionPoints(points, tree, plane, 0.1, 0.4)) EXPECT_GT(point.x(), 1.9);
  plane.origin = {0, 0, 5};
  EXPECT_TRUE(SectionPoints(points, tree, plane, 0.1, 0.4).empty());
}

TEST(AlignStarts, PlanesAlongAHelix_DoNotTurnAgainstEachOther) {
  std::vector<SectionPlane> planes;
  for (int k = 0; k < 30; ++k) {
    const double t = 0.2 * k;
    SectionPlane plane;
    plane.origin = {std::cos(t), std::sin(t), 0.5 * t};
    plane.normal = Eigen::Vector3d(-std::sin(t), std::cos(t), 0.5).normalized();
    planes.push_back(plane);
  }
  AlignStarts(Eigen::Vector3d::UnitX(), planes);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    EXPECT_NEAR(planes[k].start.norm(), 1, 1e-12);
    EXPECT_NEAR(planes[k].start.dot(planes[k].normal), 0, 1e-12);
    if (k == 0) continue;
    // No turn about the tangent between: the start changes along the normal only (to the step's third order).
    const Eigen::Vector3d change = planes[k].start - planes[k - 1].start;
    const Eigen::Vector3d middle = (planes[k].normal + planes[k - 1].normal).normalized();
    EXPECT_LT((change - change.dot(middle) * middle).norm(), 5e-3);
  }
}

}  // namespace
}  // namespace frond
