// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/control_net.h"

#include <ceres/jet.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/random.h"
#include "models/knot_vector.h"
#include "tests/models/closed_surfaces.h"
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
  const auto block = static_cast<std::size_t>(net.terms(7)[0].block);
  EXPECT_TRUE(Eigen::Vector3d(values[block].data()).isApprox(mean, 1e-14));
  values[block] = {1, 2, 3};
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  net.Read(Pointers(&values), &points, &weights);
  for (const int k : tip) {
    EXPECT_EQ(net.terms(static_cast<std::size_t>(k))[0].block, static_cast<int>(block));
    EXPECT_EQ(points[static_cast<std::size_t>(k)], Eigen::Vector3d(1, 2, 3));
  }
  EXPECT_EQ(points[6], surface.control_points()[6]);
}

TEST(ControlNet, OverlappingGroups_BecomeOne) {
  const ControlNet net(MakeSurface({}), SurfaceUnknowns::kControlPoints, {{0, 1}, {5, 6}, {1, 5}});
  EXPECT_EQ(net.num_blocks(), 53);
  for (const std::size_t k : {1, 5, 6}) EXPECT_EQ(net.terms(k)[0].block, net.terms(0)[0].block);
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
    for (std::size_t j = 0; j < 7; ++j)
      EXPECT_EQ(net.terms(i * 7 + j)[0].block, net.terms(i % 6 * 7 + j % 5)[0].block);
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
    ASSERT_EQ(cell.terms.size(), 12U);
    const int ku = static_cast<int>(c) / cells.v().count(), kv = static_cast<int>(c) % cells.v().count();
    for (std::size_t k = 0; k < 12; ++k) {
      const int i = cells.u().first(ku) + static_cast<int>(k) / 4,
                j = cells.v().first(kv) + static_cast<int>(k) % 4;
      EXPECT_EQ(cell.control_points[k], static_cast<std::size_t>(i * 8 + j));
      ASSERT_EQ(cell.terms[k].size(), 1U);
      const int block = cell.blocks[static_cast<std::size_t>(cell.terms[k][0].block)];
      EXPECT_EQ(block, net.terms(cell.control_points[k])[0].block);
      seen.insert(block);
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

// An egg whose polar rows are all but C1: each control point moved.
NurbsSurface RoughEgg(PoleEnds poles) {
  const NurbsSurface egg = Egg(poles);
  const int distinct = egg.u().num_distinct_control_points();
  Random random(3);
  std::vector<Eigen::Vector3d> points = egg.control_points();
  for (int i = 0; i < egg.count_u(); ++i) {
    for (int j = 0; j < egg.count_v(); ++j) {
      const auto k = static_cast<std::size_t>(i * egg.count_v() + j);
      if (i < distinct) {
        points[k] += Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
      } else {
        points[k] = points[k - static_cast<std::size_t>(distinct * egg.count_v())];
      }
    }
  }
  return {egg.u(), egg.v(), points};
}

// The net's blocks with random values, and the surface that they make.
struct RandomValues {
  std::vector<std::vector<double>> values;
  NurbsSurface surface;
  RandomValues(const ControlNet& net, const NurbsSurface& start) : values(StartValues(net)), surface(start) {
    Random random(7);
    for (auto& block : values) {
      for (double& value : block) value += random.Normal();
    }
    std::vector<Eigen::Vector3d> points;
    std::vector<double> weights;
    net.Read(Pointers(&values), &points, &weights);
    surface = NurbsSurface(start.u(), start.v(), points, weights);
  }
  Eigen::Vector3d Block(int block) const {
    return Eigen::Vector3d(values[static_cast<std::size_t>(block)].data());
  }
};

TEST(ControlNetPoles, TwoRowsOfAnEnd_HangOnThreeBlocks) {
  const int around = 11, along = 10;
  for (const PoleEnds poles : {PoleEnds{true, false}, PoleEnds{false, true}, PoleEnds{true, true}}) {
    const NurbsSurface start = RoughEgg({});
    const ControlNet net(start, SurfaceUnknowns::kControlPoints, {}, poles);
    const int ends = poles.begin + poles.end;
    EXPECT_EQ(net.num_blocks(), around * (along - 2 * ends) + 3 * ends);
    EXPECT_EQ(net.block_size(), 3);
    const RandomValues random(net, start);
    for (const bool end : {false, true}) {
      if (!(end ? poles.end : poles.begin)) continue;
      const int row = end ? along - 1 : 0, next = end ? along - 2 : 1;
      for (int i = 0; i < start.count_u(); ++i) {
        const auto& pole = net.terms(static_cast<std::size_t>(i * along + row));
        const auto& terms = net.terms(static_cast<std::size_t>(i * along + next));
        ASSERT_EQ(pole.size(), 1U);
        ASSERT_EQ(terms.size(), 3U);
        EXPECT_EQ(pole[0].block, net.terms(static_cast<std::size_t>(row))[0].block);
        EXPECT_EQ(terms[0].block, pole[0].block);
        EXPECT_EQ(terms[0].factor, 1);
        const double angle = 2 * M_PI * (i % around) / around;
        EXPECT_NEAR(terms[1].factor, std::cos(angle), 1e-15);
        EXPECT_NEAR(terms[2].factor, std::sin(angle), 1e-15);
        const Eigen::Vector3d centre = random.Block(terms[0].block);
        EXPECT_EQ(random.surface.control_point(i, row), centre);
        const Eigen::Vector3d expected = centre + std::cos(angle) * random.Block(terms[1].block) +
                                         std::sin(angle) * random.Block(terms[2].block);
        EXPECT_LT((random.surface.control_point(i, next) - expected).norm(), 1e-13);
      }
    }
  }
}

TEST(ControlNetPoles, Read_IsTheSumOfTheTerms) {
  const NurbsSurface start = RoughEgg({});
  const ControlNet net(start, SurfaceUnknowns::kControlPoints, {}, {.begin = true, .end = true});
  const RandomValues random(net, start);
  for (std::size_t k = 0; k < start.control_points().size(); ++k) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const BlockTerm& term : net.terms(k)) sum += term.factor * random.Block(term.block);
    EXPECT_LT((sum - random.surface.control_points()[k]).norm(), 1e-13);
  }
}

TEST(ControlNetPoles, Start_IsTheC1SurfaceItselfOrNearest) {
  const PoleEnds poles{.begin = true, .end = true};
  const NurbsSurface egg = Egg(poles);
  const ControlNet exact(egg, SurfaceUnknowns::kControlPoints, {}, poles);
  for (std::size_t k = 0; k < egg.control_points().size(); ++k) {
    EXPECT_LT((exact.start_points()[k] - egg.control_points()[k]).norm(), 1e-13);
  }
  // Of a start that is not C1 the rows' least squares: what is left is square to cos and sin.
  const NurbsSurface rough = RoughEgg(poles);
  const ControlNet net(rough, SurfaceUnknowns::kControlPoints, {}, poles);
  Eigen::Vector3d with_cosine = Eigen::Vector3d::Zero(), with_sine = with_cosine, pole = with_cosine;
  for (int i = 0; i < 11; ++i) {
    const auto k = static_cast<std::size_t>(i * 10);
    const Eigen::Vector3d left = rough.control_points()[k + 1] - net.start_points()[k + 1];
    with_cosine += std::cos(2 * M_PI * i / 11) * left;
    with_sine += std::sin(2 * M_PI * i / 11) * left;
    pole += rough.control_points()[k] - net.start_points()[k];
  }
  EXPECT_LT(with_cosine.norm() + with_sine.norm() + pole.norm(), 1e-12);
}

TEST(ControlNetPoles, AnyValues_MakeASurfaceWithOneNormalAtThePole) {
  const PoleEnds poles{.begin = true, .end = true};
  for (const int degree_v : {2, 3, 4}) {
    const NurbsSurface egg = Egg({});
    const NurbsSurface start(egg.u(), UniformBasis(degree_v, egg.count_v()), egg.control_points());
    const ControlNet net(start, SurfaceUnknowns::kControlPoints, {}, poles);
    const NurbsSurface surface = RandomValues(net, start).surface;
    for (const bool end : {false, true}) {
      const auto& terms = net.terms(end ? 8 : 1);
      const auto block = [&](std::size_t t) { return RandomValues(net, start).Block(terms[t].block); };
      const Eigen::Vector3d normal = (end ? 1 : -1) * block(1).cross(block(2)).normalized();
      double last = 0;
      for (const double v : {1e-3, 1e-5, 1e-7}) {  // the limit is reached linearly
        double farthest = 0;
        for (int k = 0; k < 20; ++k) {
          const SurfacePoint at = surface.EvaluateWithDerivatives(k / 20.0, end ? 1 - v : v);
          farthest = std::max(farthest, (at.Normal() - normal).norm());
        }
        if (last > 0) {
          EXPECT_LT(farthest, 0.02 * last) << degree_v << ' ' << v;
        }
        last = farthest;
      }
      EXPECT_LT(last, 1e-5);
    }
  }
}

TEST(ControlNetPoles, WhatHasNone_IsALogicError) {
  const NurbsSurface egg = Egg({}), sheet = MakeSurface({});
  const PoleEnds poles{.begin = true};
  using enum SurfaceUnknowns;
  EXPECT_THROW(ControlNet(egg, kWeights, {}, poles), std::logic_error);
  EXPECT_THROW(ControlNet(egg, kBoth, {}, poles), std::logic_error);
  EXPECT_THROW(ControlNet(sheet, kControlPoints, {}, poles), std::logic_error);
  const NurbsSurface tube = TurnedTube(1, 1);  // two control points along v
  EXPECT_THROW(ControlNet(tube, kControlPoints, {}, poles), std::logic_error);
  std::vector<Eigen::Vector3d> torus;
  for (int i = 0; i < 11; ++i) {
    for (int j = 0; j < 11; ++j) torus.emplace_back(i % 8, j % 8, 0);
  }
  const NurbsSurface closed(PeriodicUniformBasis(3, 8), PeriodicUniformBasis(3, 8), torus);
  EXPECT_THROW(ControlNet(closed, kControlPoints, {}, poles), std::logic_error);
  EXPECT_NO_THROW(ControlNet(egg, kControlPoints, {}, poles));
}

TEST(ControlNetPoles, Weights_OfAPolarRowBecomeTheirMean) {
  const NurbsSurface egg = Egg({});
  std::vector<double> weights;
  for (int i = 0; i < egg.count_u(); ++i) {
    for (int j = 0; j < egg.count_v(); ++j) weights.push_back(1 + 0.1 * (i % 11) + j);
  }
  const NurbsSurface start(egg.u(), egg.v(), egg.control_points(), weights);
  const ControlNet net(start, SurfaceUnknowns::kControlPoints, {}, {.begin = true});
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const auto j = static_cast<double>(k % 10);
    EXPECT_NEAR(net.start_weights()[k], j < 2 ? 1.5 + j : weights[k], 1e-14);
  }
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
