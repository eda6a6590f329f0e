// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/point_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace frond {
namespace {

// A rectangle 100 × 40, a point every unit / 2 (moved a little, so that no point lies on a slice's border):
// z = height(x, y).
template <typename F>
std::vector<Eigen::Vector3d> Sheet(const F& height) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 200; ++i) {
    for (int j = -40; j <= 40; ++j) {
      const double x = 0.5 * i, y = 0.5 * j;
      points.emplace_back(x, y, height(x, y));
    }
  }
  return points;
}

const auto kRoof = [](double, double y) { return -0.5 * std::abs(y); };
const auto kSlope = [](double, double y) { return 0.5 * y; };

TEST(PointSet, OrderedRows_RunFromMarginOverMidribToMargin) {
  PointSetOptions options;
  options.kind = PointSetKind::kOrdered;
  const PointSet set = MakePointSet(Sheet(kRoof), options);
  EXPECT_EQ(set.kind, PointSetKind::kOrdered);
  EXPECT_TRUE(set.warnings.empty());
  EXPECT_NEAR(set.midrib_offset, 0, 1e-12);
  ASSERT_EQ(set.rows.size(), 7u);
  for (std::size_t j = 1; j < 6; ++j) {
    const auto& row = set.rows[j];
    ASSERT_EQ(row.size(), 7u);
    EXPECT_EQ(row[0].y(), 20);
    EXPECT_EQ(row[3].y(), 0);
    EXPECT_EQ(row[3].z(), 0);
    EXPECT_EQ(row[6].y(), -20);
    EXPECT_NEAR(row[1].y(), 20 - 20.0 / 3, 0.5);
    EXPECT_NEAR(row[5].y(), -20 + 20.0 / 3, 0.5);
    const double plane = (set.selected[j] - 0.5) * 2;
    for (const Eigen::Vector3d& p : row) EXPECT_LE(std::abs(p.x() - plane), 1.0 + 1e-12);
    for (const std::size_t k : {0u, 3u, 6u}) EXPECT_LE(std::abs(row[k].x() - plane), 0.5 + 1e-12);
  }
}

TEST(PointSet, BaseAndTip_HaveAsManyPointsAsAnOrderedRow) {
  PointSetOptions options;
  options.left = 1;
  options.right = 3;
  const PointSet set = MakePointSet(Sheet(kRoof), options);
  ASSERT_EQ(set.rows.front().size(), 7u);
  ASSERT_EQ(set.rows.back().size(), 7u);
  const auto& base = set.rows.front();
  EXPECT_GE(base.front().y() - base.back().y(), 2);
  EXPECT_NEAR((base[2] - 0.5 * (base[0] + base[6])).norm(), 0, 1e-12);  // midrib after one point
  for (const Eigen::Vector3d& p : set.rows.back()) EXPECT_EQ(p, set.rows.back().front());
}

TEST(PointSet, UnorderedRows_HoldAllPointsOnTheCentrePlane) {
  const PointSet set = MakePointSet(Sheet(kRoof), {});
  ASSERT_EQ(set.kind, PointSetKind::kUnordered);
  for (std::size_t j = 1; j < 6; ++j) {
    EXPECT_GE(set.rows[j].size(), 3 * 81u);
    for (std::size_t k = 1; k < set.rows[j].size(); ++k) {
      EXPECT_DOUBLE_EQ(set.rows[j][k].x(), (set.selected[j] - 0.5) * 2);
      EXPECT_LE(set.rows[j][k].y(), set.rows[j][k - 1].y());
    }
  }
}

TEST(PointSet, WithoutAMidrib_FallsBackWithAWarning) {
  PointSetOptions options;
  options.kind = PointSetKind::kOrdered;
  PointSet set = MakePointSet(Sheet(kSlope), options);
  EXPECT_EQ(set.kind, PointSetKind::kUnordered);
  EXPECT_NEAR(set.midrib_offset, 1, 1e-9);
  ASSERT_EQ(set.warnings.size(), 1u);
  EXPECT_NE(set.warnings[0].find("no midrib"), std::string::npos);
  options.midrib_threshold = 2;
  EXPECT_EQ(MakePointSet(Sheet(kSlope), options).kind, PointSetKind::kOrdered);
}

TEST(PointSet, EmptySlices_AreThickenedWithAWarning) {
  std::vector<Eigen::Vector3d> points = Sheet(kRoof);
  std::erase_if(points, [](const Eigen::Vector3d& p) { return p.x() > 48 && p.x() < 56; });
  for (const PointSetKind kind : {PointSetKind::kOrdered, PointSetKind::kUnordered}) {
    PointSetOptions options;
    options.kind = kind;
    const PointSet set = MakePointSet(points, options);
    ASSERT_EQ(set.warnings.size(), 1u);
    EXPECT_NE(set.warnings[0].find("slice 26"), std::string::npos) << set.warnings[0];
    EXPECT_GE(set.rows[3].size(), 7u);
  }
}

TEST(PointSet, TooFewPoints_AreRefused) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 5; ++i) points.emplace_back(i, (i % 2) * 3, 0);
  EXPECT_THROW(MakePointSet(points, {}), InputError);
}

TEST(TestSubset, HasNinetyPointsOfTheCloudSpreadOverIt) {
  for (const bool midrib : {true, false}) {
    const std::vector<Eigen::Vector3d> points = midrib ? Sheet(kRoof) : Sheet(kSlope);
    const std::vector<Eigen::Vector3d> subset = MakeTestSubset(points, {});
    ASSERT_EQ(subset.size(), 90u);
    for (std::size_t i = 0; i < subset.size(); ++i) {
      EXPECT_NE(std::find(points.begin(), points.end(), subset[i]), points.end());
      const double x = 5 + 10.0 * static_cast<double>(i / 9), y = 20 - 5.0 * static_cast<double>(i % 9);
      EXPECT_NEAR(subset[i].x(), x, 5.001);
      EXPECT_NEAR(subset[i].y(), y, 0.75);
    }
  }
}

}  // namespace
}  // namespace frond
