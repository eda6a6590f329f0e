// SPDX-License-Identifier: BSD-3-Clause
#include "models/polygon_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.h"

namespace frond {
namespace {

double TotalTwiceArea(const std::vector<LatticePoint>& points,
                      const std::vector<std::array<int, 3>>& triangles) {
  double sum = 0;
  for (const auto& triangle : triangles) {
    const double area = TwiceArea(points, triangle);
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

TEST(TriangulatePolygon, StraightCorners_BelongToTrianglesWithArea) {
  const std::vector<LatticePoint> points = {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}, {0, 1}};
  const auto triangles = TriangulatePolygon(points, {0, 1, 2, 3, 4, 5, 6, 7}, {});
  EXPECT_EQ(triangles.size(), 6u);
  EXPECT_EQ(TotalTwiceArea(points, triangles), 32);
}

TEST(TriangulatePolygon, ToothedPolygonsWithHoles_AreCoveredExactly) {
  Random random(41);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<LatticePoint> points;
    const auto ring = [&](double cu, double cv, double low, double high, int corners, bool clockwise) {
      std::vector<int> polygon;
      for (int k = 0; k < corners; ++k) {
        const double angle = 6.283185307179586 * k / corners * (clockwise ? -1 : 1),
                     r = random.Uniform(low, high);
        polygon.push_back(static_cast<int>(points.size()));
        points.push_back({std::llround((cu + r * std::cos(angle)) * 0x1p49),
                          std::llround((cv + r * std::sin(angle)) * 0x1p49)});
      }
      return polygon;
    };
    const auto outer = ring(1, 1, 0.5, 0.99, 60, false);
    const std::vector<std::vector<int>> holes = {
        ring(0.8, 1, 0.02, 0.09, 12, true), ring(1.2, 1, 0.02, 0.15, 9, true),
        ring(1, 1.3, 0.01, 0.1, 5, true), ring(1, 0.7, 0.01, 0.1, 30, true)};
    double expected = TwiceArea(points, outer);
    std::size_t corners = 60;
    for (const auto& hole : holes) {
      expected += TwiceArea(points, hole);
      corners += hole.size() + 2;
    }
    const auto triangles = TriangulatePolygon(points, outer, holes);
    EXPECT_EQ(triangles.size(), corners - 2);
    EXPECT_NEAR(TotalTwiceArea(points, triangles) / expected, 1, 1e-12);
  }
}

TEST(FirstClockwise, AmongSeveral_KeepsTheInsideOnTheLeft) {
  const std::vector<LatticePoint> points = {{0, 0}, {-1, 0}, {0, 1}, {1, 0}, {0, -1}};
  const std::vector<int> ends = {4, 3, 2};
  EXPECT_EQ(FirstClockwise(points, 0, 1, ends), 2u);
  EXPECT_EQ(FirstClockwise(points, 0, 2, ends), 1u);  // the spike back to 2 comes last
}

}  // namespace
}  // namespace frond
