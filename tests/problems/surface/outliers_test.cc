// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// A curved sheet over the unit square, `side`² points.
Points Sheet(int side) {
  Points points;
  for (const auto& p : JitteredSquare(side, 3))
    points.emplace_back(p.x(), p.y(), 0.2 * std::sin(3 * p.x()) * p.y());
  return points;
}

int Count(const std::vector<std::uint8_t>& flags) { return std::accumulate(flags.begin(), flags.end(), 0); }

TEST(PointSpacing, OfAJitteredGrid_IsItsSpacing) {
  const Points points = Sheet(100);
  EXPECT_NEAR(PointSpacing(points, KdTree(points)), 0.01, 0.0015);
}

TEST(PointSpacing, ScalesWithThePoints) {
  Points points = Sheet(50);
  const double spacing = PointSpacing(points, KdTree(points));
  for (auto& point : points) point *= 1000;
  EXPECT_NEAR(PointSpacing(points, KdTree(points)), 1000 * spacing, 1e-9 * 1000 * spacing);
}

TEST(StrayPoints, DenseSheet_HasNone) {
  const Points points = Sheet(60);
  EXPECT_EQ(Count(StrayPoints(points)), 0);
}

TEST(StrayPoints, ClustersAndSinglePointsApart_AreAllFound) {
  Points points = Sheet(60);
  const std::size_t sheet = points.size();
  Random random(5);
  for (int i = 0; i < 40; ++i)
    points.emplace_back(1.5 + 0.02 * random.Uniform(), 0.5, 0.02 * random.Uniform());
  for (int i = 0; i < 20; ++i) points.emplace_back(0.3 + 0.02 * random.Uniform(), 0.3, -0.5);
  points.emplace_back(40, -300, 7);
  const auto stray = StrayPoints(points);
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(stray[i], i >= sheet ? 1 : 0) << i;
}

TEST(StrayPoints, OneAbsurdlyFarPoint_LeavesTheSheetWhole) {
  Points points = Sheet(60);
  points.emplace_back(1e9, 0, 0);
  const auto stray = StrayPoints(points);
  EXPECT_EQ(Count(stray), 1);
  EXPECT_EQ(stray.back(), 1);
}

TEST(StrayPoints, PointsWithoutExtent_AreNone) {
  const Points same(10, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(Count(StrayPoints(same)), 0);
  EXPECT_TRUE(StrayPoints(Points{}).empty());
}

// Offsets of a sheet's points from a surface: noise of 0.01 in z.
struct Offsets {
  Points points = Sheet(60);
  Points values;
  Offsets() {
    Random random(6);
    for (std::size_t i = 0; i < points.size(); ++i) values.emplace_back(0, 0, 0.01 * random.Normal());
  }
  std::vector<std::uint8_t> Outlying(double threshold) const {
    std::vector<Eigen::Vector3d> scan = points;  // the surface is the plane z = 0
    for (std::size_t i = 0; i < scan.size(); ++i) scan[i] += values[i];
    return OutlyingPoints(scan, values, KdTree(scan), threshold);
  }
};

TEST(OutlyingPoints, NoiseAlone_IsNotFlagged) { EXPECT_EQ(Count(Offsets().Outlying(6)), 0); }

TEST(OutlyingPoints, SinglePointsThatStandOut_AreFoundOnBothSides) {
  Offsets offsets;
  for (std::size_t i = 50; i < 3600; i += 97) offsets.values[i].z() = i % 2 == 0 ? 0.15 : -0.15;
  const auto outlying = offsets.Outlying(6);
  for (std::size_t i = 0; i < outlying.size(); ++i) {
    ASSERT_EQ(outlying[i] != 0, std::abs(offsets.values[i].z()) > 0.1) << i;
  }
}

TEST(OutlyingPoints, PointThatStandsOutSideways_IsFound) {
  Offsets offsets;
  offsets.values[10] = {-0.2 - offsets.points[10].x(), 0, 0};  // beyond the edge
  const auto outlying = offsets.Outlying(6);
  EXPECT_EQ(Count(outlying), 1);
  EXPECT_EQ(outlying[10], 1);
}

TEST(OutlyingPoints, ErrorOfTheModel_IsNotFlagged) {
  // The surface misses a ridge by 50 σ: what a whole neighbourhood has in common.
  Offsets offsets;
  for (std::size_t i = 0; i < offsets.points.size(); ++i) {
    const double x = offsets.points[i].x() - 0.5;
    offsets.values[i].z() += 0.5 * std::exp(-x * x / (2 * 0.1 * 0.1));
  }
  EXPECT_LE(Count(offsets.Outlying(6)), 2);
}

TEST(OutlyingPoints, ClustersOfAFew_AreFound) {
  Offsets offsets;
  const KdTree tree(offsets.points);
  std::vector<KdTree::Neighbour> cluster(4);
  tree.Nearest({0.4, 0.6, 0}, cluster);
  for (const auto& member : cluster) offsets.values[member.index].z() = 0.3;
  const auto outlying = offsets.Outlying(6);
  EXPECT_EQ(Count(outlying), 4);
  for (const auto& member : cluster) EXPECT_EQ(outlying[member.index], 1);
}

}  // namespace
}  // namespace frond
