// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/boundary_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Ring = std::vector<std::uint32_t>;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double SignedArea(const Points& points, const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += Cross(points[ring[i]], points[ring[(i + 1) % ring.size()]]);
  return sum / 2;
}

bool ProperlyCross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d) {
  return Cross(b - a, c - a) * Cross(b - a, d - a) < 0 && Cross(d - c, a - c) * Cross(d - c, b - c) < 0;
}

// No vertex twice, no two sides that cross.
void ExpectSimplePolygon(const Points& points, const Ring& ring) {
  ASSERT_GE(ring.size(), 3U);
  std::set<std::pair<double, double>> places;
  for (const auto i : ring) {
    ASSERT_LT(i, points.size());
    EXPECT_TRUE(places.emplace(points[i].x(), points[i].y()).second) << "passes a place twice";
  }
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      EXPECT_FALSE(ProperlyCross(points[ring[i]], points[ring[(i + 1) % n]], points[ring[j]],
                                 points[ring[(j + 1) % n]]));
    }
  }
}

constexpr int kSide = 80;
constexpr double kSpacing = 1.0 / kSide;
constexpr double kRadius = 4 * kSpacing;

template <typename Keep>
Points JitteredPointsWhere(Keep keep) {
  Points points = JitteredSquare(kSide, 4);
  std::erase_if(points, [&](const Eigen::Vector2d& p) { return !keep(p); });
  return points;
}

TEST(BoundaryRing, OfADisc_IsASimplePolygonAroundItsArea) {
  const Points points =
      JitteredPointsWhere([](const auto& p) { return (p - Eigen::Vector2d(0.5, 0.5)).norm() < 0.48; });
  const Ring ring = BoundaryRing(points, kRadius);
  ExpectSimplePolygon(points, ring);
  const double area = M_PI * 0.48 * 0.48;  // the outermost points lie half a spacing inside, about
  EXPECT_LT(SignedArea(points, ring), area);
  EXPECT_GT(SignedArea(points, ring), area - 2 * M_PI * 0.48 * kSpacing);
}

TEST(BoundaryRing, OfASquareWithANotch_GoesIntoTheNotch) {
  const auto in_notch = [](const Eigen::Vector2d& p) { return p.y() > 0.5 && std::abs(p.x() - 0.5) < 0.15; };
  const Points points = JitteredPointsWhere([&](const auto& p) { return !in_notch(p); });
  const Ring ring = BoundaryRing(points, kRadius);
  ExpectSimplePolygon(points, ring);
  EXPECT_NEAR(SignedArea(points, ring), 1 - 0.15, 5 * kSpacing);
  const auto on_notch_floor = [&](std::uint32_t i) {
    return std::abs(points[i].x() - 0.5) < 0.1 && std::abs(points[i].y() - 0.5) < 2 * kSpacing;
  };
  EXPECT_TRUE(std::any_of(ring.begin(), ring.end(), on_notch_floor));
}

TEST(BoundaryRing, OfAnAnnulus_IsItsOuterLoopAlone) {
  const Eigen::Vector2d centre(0.5, 0.5);
  const Points points = JitteredPointsWhere([&](const auto& p) {
    const double r = (p - centre).norm();
    return r < 0.48 && r > 0.2;
  });
  const Ring ring = BoundaryRing(points, kRadius);
  ExpectSimplePolygon(points, ring);
  for (const auto i : ring) EXPECT_GT((points[i] - centre).norm(), 0.4);
  EXPECT_NEAR(SignedArea(points, ring), M_PI * 0.48 * 0.48, 2 * M_PI * 0.48 * kSpacing);
}

TEST(BoundaryRing, OfTwoPartsThatTouchInAPoint_IsTheLargersOwnLoop) {
  // Two diamonds on a unit grid, tip to tip in (0, 0). A cell's triangles have the circumradius 0.71, those
  // that would bridge the gap beside the tips 1.
  Points points;
  for (int i = -24; i <= 16; ++i) {
    for (int j = -12; j <= 12; ++j) {
      if (std::abs(i + 12) + std::abs(j) <= 12 || std::abs(i - 8) + std::abs(j) <= 8)
        points.emplace_back(i, j);
    }
  }
  const Ring ring = BoundaryRing(points, 0.8);
  ExpectSimplePolygon(points, ring);
  EXPECT_EQ(SignedArea(points, ring), 288);
  EXPECT_EQ(ring.size(), 48U);
}

TEST(BoundaryRing, WithAPointFarAway_LeavesItOut) {
  Points points = JitteredSquare(40, 4);
  const Ring without = BoundaryRing(points, 4.0 / 40);
  points.emplace_back(30, -40);
  const Ring with = BoundaryRing(points, 4.0 / 40);
  EXPECT_EQ(std::count(with.begin(), with.end(), points.size() - 1), 0);
  EXPECT_NEAR(SignedArea(points, with), SignedArea(points, without), 1e-3);
}

TEST(BoundaryRing, WithDuplicates_IsTheSameLoop) {
  Points points = JitteredSquare(40, 4);
  const double area = SignedArea(points, BoundaryRing(points, 4.0 / 40));
  const Points once = points;
  points.insert(points.end(), once.begin(), once.end());
  points.insert(points.end(), once.begin(), once.begin() + 100);
  const Ring ring = BoundaryRing(points, 4.0 / 40);
  ExpectSimplePolygon(points, ring);
  EXPECT_NEAR(SignedArea(points, ring), area, 1e-12);
}

TEST(BoundaryRing, OfCollinearOrTooFewPoints_IsEmpty) {
  Points line;
  for (int i = 0; i < 50; ++i) line.emplace_back(i, 2 * i);
  EXPECT_TRUE(BoundaryRing(line, 10).empty());
  EXPECT_TRUE(BoundaryRing(Points{}, 1).empty());
  EXPECT_TRUE(BoundaryRing(Points{{0, 0}}, 1).empty());
  EXPECT_TRUE(BoundaryRing(Points{{0, 0}, {1, 0}}, 1).empty());
  EXPECT_TRUE(BoundaryRing(Points(10, Eigen::Vector2d(3, 4)), 1).empty());
}

TEST(BoundaryRing, WithARadiusBelowTheSpacing_IsEmpty) {
  EXPECT_TRUE(BoundaryRing(JitteredSquare(20, 4), 1e-3).empty());
}

TEST(BoundaryRing, OfThreePoints_IsCounterClockwiseEitherWay) {
  const Points left{{0, 0}, {4, 0}, {0, 3}}, right{{0, 0}, {0, 3}, {4, 0}};
  EXPECT_EQ(SignedArea(left, BoundaryRing(left, 10)), 6);
  EXPECT_EQ(SignedArea(right, BoundaryRing(right, 10)), 6);
}

TEST(BoundaryRing, OfScaledAndShiftedPoints_IsTheSameLoop) {
  const Points points = JitteredPointsWhere([](const auto& p) { return p.x() + p.y() < 1.4; });
  Points metres;
  for (const auto& p : points) metres.emplace_back(5.4e3 + 1e-3 * p.x(), -2e3 + 1e-3 * p.y());
  EXPECT_EQ(BoundaryRing(points, kRadius), BoundaryRing(metres, 1e-3 * kRadius));
}

}  // namespace
}  // namespace frond
