// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/margin_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/knot_vector.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// x = v, y = u over [0, 20] × [0, 50].
NurbsSurface Rectangle() { return MakeSurface({.degree_u = 1, .degree_v = 1, .roughness = 0}); }

Points RectangleRing(double x0, double y0, double x1, double y1, double z) {
  Points ring;
  const auto side = [&](double ax, double ay, double bx, double by) {
    for (int k = 0; k < 25; ++k) ring.emplace_back(ax + (bx - ax) * k / 25, ay + (by - ay) * k / 25, z);
  };
  side(x0, y0, x1, y0);
  side(x1, y0, x1, y1);
  side(x1, y1, x0, y1);
  side(x0, y1, x0, y0);
  return ring;
}

double Cost(const SurfaceCells& cells, const MarginRow& row) {
  const Eigen::Vector3d r = cells.Evaluate(row.u, row.v) - row.target;
  return row.weight * r.dot(row.matrix * r);
}

TEST(MarginRows, RingOnTheEdges_CostsNothing) {
  const SurfaceCells cells(Rectangle());
  MarginOptions options;
  options.rings = {RectangleRing(0, 0, 50, 20, 0)};
  const auto rows = MakeMarginRows(cells, options, 1000);
  EXPECT_EQ(rows.size(), 100U + 4 * 60);
  for (const MarginRow& row : rows) EXPECT_NEAR(Cost(cells, row), 0, 1e-16);
}

TEST(MarginRows, RingAboveTheEdges_CostsItsHeightBothWays) {
  const SurfaceCells cells(Rectangle());
  MarginOptions options;
  options.rings = {RectangleRing(0, 0, 50, 20, 0.5)};
  double total = 0;
  for (const MarginRow& row : MakeMarginRows(cells, options, 1000)) total += Cost(cells, row);
  EXPECT_NEAR(total, 2 * 0.1 * 1000 * 0.25, 1e-6);  // weight · N · height², once for each direction
}

TEST(MarginRows, SurfaceThatOverhangs_IsPulledInByItsEdgeSamples) {
  // The ring is a small piece in one corner: its own rows alone would be content with the two edges there.
  const SurfaceCells cells(Rectangle());
  MarginOptions options;
  options.rings = {RectangleRing(0, 0, 10, 10, 0)};
  double largest = 0;
  for (const MarginRow& row : MakeMarginRows(cells, options, 1000)) {
    const Eigen::Vector3d r = cells.Evaluate(row.u, row.v) - row.target;
    largest = std::max(largest, std::sqrt(r.dot(row.matrix * r)));
  }
  EXPECT_GT(largest, 30);
}

TEST(MarginRows, Matrices_AreProjectionsOfRankTwoOrThree) {
  const NurbsSurface surface = MakeSurface({.uneven_knots = true, .rational = true});
  MarginOptions options;
  options.rings = {RectangleRing(-2, -3, 52, 22, 1)};
  for (const MarginRow& row : MakeMarginRows(SurfaceCells(surface), options, 1000)) {
    EXPECT_TRUE((row.matrix * row.matrix).isApprox(row.matrix, 1e-12));
    const double rank = row.matrix.trace();
    EXPECT_TRUE(std::abs(rank - 2) < 1e-9 || std::abs(rank - 3) < 1e-9) << rank;
    EXPECT_GT(row.weight, 0);
  }
}

TEST(MarginRows, PeriodicDirection_HasNoEdges) {
  const BSplineBasis u = PeriodicUniformBasis(3, 8), v = UniformBasis(1, 2);
  Points control_points;
  for (int i = 0; i < 11; ++i) {
    const double a = 2 * M_PI * (i % 8) / 8;
    for (int j = 0; j < 2; ++j) control_points.emplace_back(5.0 * j, std::cos(a), std::sin(a));
  }
  MarginOptions options;
  options.rings = {RectangleRing(0, 0, 1, 1, 0)};
  const auto rows = MakeMarginRows(SurfaceCells(NurbsSurface(u, v, control_points)), options, 1000);
  EXPECT_EQ(rows.size(), 100U + 2 * 60);
  for (const MarginRow& row : rows) EXPECT_TRUE(row.v == 0 || row.v == 1);
}

}  // namespace
}  // namespace frond
