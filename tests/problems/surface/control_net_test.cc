// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/control_net.h"

#include <ceres/jet.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "models/knot_vector.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

std::vector<std::vector<double>> StartValues(const ControlNet& net) {
  std::vector<std::vector<double>> values;
  for (const ParameterBlock& block : net.ParameterBlocks()) values.push_back(block.start);
  return values;
}

std::vector<double*> Pointers(std::vector<std::vector<double>>* values) {
  std::vector<double*> pointers;
  for (std::vector<double>& block : *values) pointers.push_back(block.data());
  return pointers;
}

TEST(ControlNet, WithoutTies_HasABlockAControlPointAndReadsItsStartBack) {
  const NurbsSurface surface = MakeSurface({.rational = true});
  for (const auto unknowns :
       {SurfaceUnknowns::kControlPoints, SurfaceUnknowns::kWeights, SurfaceUnknowns::kBoth}) {
    const ControlNet net(surface, unknowns);
    EXPECT_EQ(net.num_blocks(), 56);
    auto values = StartValues(net);
    for (const auto& block : values) EXPECT_EQ(static_cast<int>(block.size()), net.block_size());
    std::vector<Eigen::Vector3d> points;
    std::vector<double> weights;
    net.Read(Pointers(&values), &points, &weights);
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k], surface.control_points()[k]);
      EXPECT_NEAR(weights[k], surface.weights()[k], 1e-15 * 4);
    }
  }
}

TEST(ControlNet, TiedControlPoints_AreOneBlockThatStartsInTheirMean) {
  const NurbsSurface surface = MakeSurface({});
  const std::vector<int> tip = {7, 15, 23, 31, 39, 47, 55};
  const ControlNet net(surface, SurfaceUnknowns::kControlPoints, {tip});
  EXPECT_EQ(net.num_blocks(), 56 - 6);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int k : tip) mean += surface.control_points()[static_cast<std::size_t>(k)] / 7;
  auto values = StartValues(net);
  const auto block = static_cast<std::size_t>(net.block_of(7));
  EXPECT_TRUE(Eigen::Vector3d(values[block].data()).isApprox(mean, 1e-14));
  values[block] = {1, 2, 3};
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  net.Read(Pointers(&values), &points, &weights);
  for (const int k : tip) {
    EXPECT_EQ(net.block_of(static_cast<std::size_t>(k)), static_cast<int>(block));
    EXPECT_EQ(points[static_cast<std::size_t>(k)], Eigen::Vector3d(1, 2, 3));
  }
  EXPECT_EQ(points[6], surface.control_points()[6]);
}

TEST(ControlNet, OverlappingGroups_BecomeOne) {
  const ControlNet net(MakeSurface({}), SurfaceUnknowns::kControlPoints, {{0, 1}, {5, 6}, {1, 5}});
  EXPECT_EQ(net.num_blocks(), 53);
  for (const std::size_t k : {1, 5, 6}) EXPECT_EQ(net.block_of(k), net.block_of(0));
}

TEST(ControlNet, PeriodicDirections_ShareTheBlocksOfTheirRepeats) {
  const BSplineBasis u = PeriodicUniformBasis(3, 6), v = PeriodicUniformBasis(2, 5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 7; ++j) {
      const double a = 2 * M_PI * (i % 6) / 6, b = 2 * M_PI * (j % 5) / 5;
      points.emplace_back((3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b));
    }
  }
  const NurbsSurface torus(u, v, points);
  const ControlNet net(torus, SurfaceUnknowns::kBoth);
  EXPECT_EQ(net.num_blocks(), 30);
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 7; ++j) EXPECT_EQ(net.block_of(i * 7 + j), net.block_of(i % 6 * 7 + j % 5));
  }
  const SurfaceCells cells(torus);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  ASSERT_EQ(layout.size(), 30U);
  for (const CellBlocks& cell : layout) EXPECT_EQ(cell.blocks.size(), 12U);
}

TEST(ControlNet, BlocksOfCells_ListEachBlockOnceAndPlaceEveryControlPoint) {
  const NurbsSurface surface = MakeSurface({.degree_u = 2});
  const ControlNet net(surface, SurfaceUnknowns::kControlPoints, {{7, 15, 23, 31, 39, 47, 55}});
  const SurfaceCells cells(surface);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  ASSERT_EQ(static_cast<int>(layout.size()), cells.count());
  std::set<int> seen;
  for (std::size_t c = 0; c < layout.size(); ++c) {
    const CellBlocks& cell = layout[c];
    EXPECT_EQ(std::set<int>(cell.blocks.begin(), cell.blocks.end()).size(), cell.blocks.size());
    ASSERT_EQ(cell.place.size(), 12U);
    const int ku = static_cast<int>(c) / cells.v().count(), kv = static_cast<int>(c) % cells.v().count();
    for (std::size_t k = 0; k < 12; ++k) {
      const int i = cells.u().first(ku) + static_cast<int>(k) / 4,
                j = cells.v().first(kv) + static_cast<int>(k) % 4;
      EXPECT_EQ(cell.control_points[k], static_cast<std::size_t>(i * 8 + j));
      EXPECT_EQ(cell.blocks[static_cast<std::size_t>(cell.place[k])], net.block_of(cell.control_points[k]));
      seen.insert(net.block_of(cell.control_points[k]));
    }
  }
  EXPECT_EQ(static_cast<int>(seen.size()), net.num_blocks());
}

TEST(ControlNet, Weights_HoldOneOfThemAsTheGauge) {
  const NurbsSurface surface = MakeSurface({.rational = true});
  const auto weights = ControlNet(surface, SurfaceUnknowns::kWeights).ParameterBlocks();
  EXPECT_TRUE(weights[0].constant);
  EXPECT_EQ(std::count_if(weights.begin(), weights.end(), [](const auto& block) { return block.constant; }),
            1);
  const auto both = ControlNet(surface, SurfaceUnknowns::kBoth).ParameterBlocks();
  ASSERT_NE(both[0].manifold, nullptr);
  EXPECT_EQ(both[0].manifold->TangentSize(), 3);
  EXPECT_EQ(both[1].manifold, nullptr);
}

// ∂(wP, w)/∂(P, ω) at w = e^ω by auto-diff.
Eigen::Matrix4d TangentByAutoDiff(const Eigen::Vector3d& point, double weight) {
  using Jet = ceres::Jet<double, 4>;
  const Jet w = exp(Jet(std::log(weight), 3));
  Eigen::Matrix4d tangent;
  for (int x = 0; x < 3; ++x) tangent.row(x) = (w * Jet(point[x], x)).v.transpose();
  tangent.row(3) = w.v.transpose();
  return tangent;
}

TEST(ControlNet, Tangent_EqualsAutoDiffOfHomogeneousCoordinates) {
  const NurbsSurface surface = MakeSurface({.rational = true});
  const Eigen::Vector3d point(1.5, -2, 0.25);
  const double weight = 1.3;
  const Eigen::Matrix4d expected = TangentByAutoDiff(point, weight);
  EXPECT_TRUE(ControlNet(surface, SurfaceUnknowns::kBoth).Tangent(point, weight).isApprox(expected, 1e-15));
  EXPECT_TRUE(ControlNet(surface, SurfaceUnknowns::kWeights)
                  .Tangent(point, weight)
                  .isApprox(expected.rightCols<1>(), 1e-15));
  EXPECT_TRUE(ControlNet(surface, SurfaceUnknowns::kControlPoints)
                  .Tangent(point, weight)
                  .isApprox(expected.topLeftCorner<3, 3>(), 1e-15));
}

}  // namespace
}  // namespace frond
