// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/random.h"
#include "models/kd_tree.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points Cloud(int count) {
  Random random(2);
  Points points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(random.Uniform(0, 60), random.Uniform(0, 20), random.Normal());
  return points;
}

Points InOrder(const Points& points) {
  Points ordered;
  for (const auto i : SpatialOrder(points)) ordered.push_back(points[i]);
  return ordered;
}

TEST(SpatialOrder, IsAPermutation) {
  const Points points = Cloud(5000);
  std::vector<std::uint32_t> order = SpatialOrder(points), all(points.size());
  std::sort(order.begin(), order.end());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(order, all);
}

TEST(SpatialOrder, DoesNotDependOnTheOrderInTheFile) {
  Points points = Cloud(5000);
  for (int i = 0; i < 200; ++i)
    points.push_back(points[static_cast<std::size_t>(i)] + Eigen::Vector3d(1e-7, 0, 0));
  const Points ordered = InOrder(points);
  Random random(3);
  for (std::size_t i = points.size() - 1; i > 0; --i) std::swap(points[i], points[random.Below(i + 1)]);
  EXPECT_EQ(InOrder(points), ordered);
}

TEST(SpatialOrder, PutsNeighboursInSpaceNearEachOther) {
  const Points points = Cloud(20000), ordered = InOrder(points);
  double before = 0, after = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    before += (points[i] - points[i - 1]).norm();
    after += (ordered[i] - ordered[i - 1]).norm();
  }
  EXPECT_LT(after, 0.05 * before);
}

TEST(SpatialOrder, EveryKthPoint_IsAnEvenThinning) {
  const Points ordered = InOrder(Cloud(20000));
  Points thinned;
  for (std::size_t i = 0; i < ordered.size(); i += 20) thinned.push_back(ordered[i]);
  // 1,000 points over 60 × 20: 1.1 apart. A random pick of as many leaves gaps of four times that.
  const KdTree tree(thinned);
  double largest_gap = 0;
  for (const auto& point : ordered) largest_gap = std::max(largest_gap, tree.Nearest(point).squared_distance);
  EXPECT_LT(std::sqrt(largest_gap), 4.5);
}

TEST(SpatialOrder, OfFewOrEqualPoints_IsWellDefined) {
  EXPECT_TRUE(SpatialOrder(Points{}).empty());
  EXPECT_EQ(SpatialOrder(Points{{1, 2, 3}}), std::vector<std::uint32_t>{0});
  EXPECT_EQ(SpatialOrder(Points(3, Eigen::Vector3d(1, 2, 3))).size(), 3U);
}

}  // namespace
}  // namespace frond
