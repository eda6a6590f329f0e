// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/slicing.h"

#include <gtest/gtest.h>

#include "base/errors.h"

namespace frond {
namespace {

// A triangle in the plane z = 1: half-width x / 4 from 1 to 11, pointed end first turned round: the base is
// wide.
std::vector<Eigen::Vector3d> Triangle() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 1000; ++i) {
    const double x = 1 + 0.01 * i, half = (11 - x) / 4;
    for (int j = -10; j <= 10; ++j) points.emplace_back(x, half * j / 10, 1);
  }
  return points;
}

TEST(Slicing, Selection_IsThePapers) {
  EXPECT_EQ(SelectSlices(50, 7), (std::vector<int>{0, 9, 17, 26, 34, 43, 51}));
  EXPECT_EQ(SelectSlices(10, 8), (std::vector<int>{0, 2, 3, 5, 6, 8, 9, 11}));
  EXPECT_EQ(SelectSlices(4, 6), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(SelectSlices(1, 3), (std::vector<int>{0, 1, 2}));
}

TEST(Slicing, MoreSelectedThanThereAre_IsRefused) {
  EXPECT_THROW(SelectSlices(4, 7), ConfigError);
  EXPECT_THROW(SelectSlices(50, 2), ConfigError);
}

TEST(Slicing, PlanesAndThickness_FollowEquationsOneToThree) {
  const LeafSlices slices = SliceLeaf(Triangle(), 50, 2);
  EXPECT_DOUBLE_EQ(slices.length, 10);
  EXPECT_DOUBLE_EQ(slices.thickness, 0.2);
  EXPECT_DOUBLE_EQ(slices.Plane(0), 1);
  EXPECT_DOUBLE_EQ(slices.Plane(1), 1.1);
  EXPECT_DOUBLE_EQ(slices.Plane(50), 10.9);
  EXPECT_DOUBLE_EQ(slices.Plane(51), 11);
}

TEST(Slicing, EverySlice_HoldsThePointsWithinHalfAThickness) {
  const std::vector<Eigen::Vector3d> points = Triangle();
  const LeafSlices slices = SliceLeaf(points, 50, 2);
  std::size_t sum = 0;
  for (int i = 1; i <= 50; ++i) {
    for (const std::size_t k : slices.points[static_cast<std::size_t>(i - 1)]) {
      EXPECT_LE(std::abs(points[k].x() - slices.Plane(i)), 0.1 + 1e-12);
    }
    sum += slices.points[static_cast<std::size_t>(i - 1)].size();
  }
  EXPECT_EQ(sum, points.size());
  EXPECT_EQ(PointsNearPlane(points, slices, 20, 0.0999).size(), slices.points[19].size() - 21);
}

TEST(Slicing, Base_IsAsWideAsThePetiole) {
  // From the wide end: the first row of points already spans 5.
  LeafSlices slices = SliceLeaf(Triangle(), 50, 2);
  EXPECT_DOUBLE_EQ(slices.base_left.y(), -slices.base_right.y());
  EXPECT_GE(slices.base_left.y() - slices.base_right.y(), 2);
  // From the pointed end: where half-width x / 4 makes the width 2.
  std::vector<Eigen::Vector3d> turned = Triangle();
  for (Eigen::Vector3d& p : turned) p.x() = -p.x();
  slices = SliceLeaf(turned, 50, 2);
  EXPECT_NEAR(slices.base_left.y() - slices.base_right.y(), 2, 0.06);
  EXPECT_DOUBLE_EQ(slices.base_left.x(), -11);
  EXPECT_DOUBLE_EQ(slices.base_left.z(), 1);
  EXPECT_EQ(slices.base_middle, Eigen::Vector3d(0.5 * (slices.base_left + slices.base_right)));
}

TEST(Slicing, Tip_IsTheMeanOfThePointsFurthestOut) {
  std::vector<Eigen::Vector3d> points = Triangle();
  EXPECT_EQ(SliceLeaf(points, 50, 2).tip, Eigen::Vector3d(11, 0, 1));
  points.emplace_back(12, 1, 3);
  points.emplace_back(12, 2, 5);
  EXPECT_EQ(SliceLeaf(points, 50, 2).tip, Eigen::Vector3d(12, 1.5, 4));
}

TEST(Slicing, WidthsAndCounts_AreChecked) {
  EXPECT_THROW(SliceLeaf(Triangle(), 0, 2), ConfigError);
  EXPECT_THROW(SliceLeaf(Triangle(), 50, 0), ConfigError);
  try {
    SliceLeaf(Triangle(), 50, 7);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("petiole_width"), std::string::npos);
  }
}

}  // namespace
}  // namespace frond
