// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/fold_hinge.h"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/models/closed_surfaces.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

// residual = scale · (limit − J), J = (S_u × S_v)·n over the cell's blocks, with n = n₀ / J₀: the definition.
struct HingeResidual {
  Eigen::MatrixXd basis;  // row k: B_k, ∂_u B_k, ∂_v B_k
  const CellBlocks* layout;
  const ControlNet* net;
  Eigen::Vector3d normal;
  double limit, scale;

  template <typename T>
  bool operator()(T const* const* blocks, T* residual) const {
    using std::exp;
    using Vector = Eigen::Matrix<T, 3, 1>;
    const int size = net->block_size();
    Vector sums[3];
    T weights[3];
    for (int d = 0; d < 3; ++d) {
      sums[d].setZero();
      weights[d] = T(0.0);
    }
    for (std::size_t k = 0; k < layout->terms.size(); ++k) {
      const std::vector<BlockTerm>& terms = layout->terms[k];
      const std::size_t control_point = layout->control_points[k];
      T weight(net->start_weights()[control_point]);
      Vector point = net->start_points()[control_point].template cast<T>();
      if (net->unknowns() != SurfaceUnknowns::kControlPoints) {
        weight = exp(blocks[terms[0].block][size - 1]);
      }
      if (net->unknowns() != SurfaceUnknowns::kWeights) {
        point.setZero();
        for (const BlockTerm& term : terms) {
          const T* block = blocks[term.block];
          point += term.factor * Vector(block[0], block[1], block[2]);
        }
      }
      for (int d = 0; d < 3; ++d) {
        const T factor = weight * basis(static_cast<Eigen::Index>(k), d);
        sums[d] += factor * point;
        weights[d] += factor;
      }
    }
    const Vector position = sums[0] / weights[0];
    const Vector du = (sums[1] - weights[1] * position) / weights[0];
    const Vector dv = (sums[2] - weights[2] * position) / weights[0];
    residual[0] = scale * (limit - du.cross(dv).dot(normal.template cast<T>()));
    return true;
  }
};

Eigen::MatrixXd BasisAt(const SurfaceCells& cells, int cell, double u, double v) {
  const int p = cells.u().degree(), q = cells.v().degree();
  Eigen::MatrixXd nu(p + 1, 2), nv(q + 1, 2), basis((p + 1) * (q + 1), 3);
  cells.u().Evaluate(cell / cells.v().count(), u, 1, nu.data());
  cells.v().Evaluate(cell % cells.v().count(), v, 1, nv.data());
  for (int k = 0; k < basis.rows(); ++k) {
    const int a = k / (q + 1), b = k % (q + 1);
    basis.row(k) << nu(a, 0) * nv(b, 0), nu(a, 1) * nv(b, 0), nu(a, 0) * nv(b, 1);
  }
  return basis;
}

// A surface pulled about so much that it folds here and there.
NurbsSurface Crumpled(const NurbsSurface& surface) {
  Random random(11);
  std::vector<Eigen::Vector3d> points = surface.control_points();
  for (Eigen::Vector3d& point : points) {
    point += 6 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
  }
  if (surface.u().periodic()) {
    const auto repeats = static_cast<std::size_t>(surface.u().degree() * surface.count_v());
    std::copy_n(points.begin(), repeats, points.end() - static_cast<std::ptrdiff_t>(repeats));
  }
  return NurbsSurface(surface.u(), surface.v(), points, surface.weights());
}

void ExpectRowsOfDefinition(const NurbsSurface& reference, const ControlNet& net) {
  SurfaceCells cells{reference};
  cells.Update(net.start_points(), net.start_weights());
  const FoldHinge hinge(SurfaceCells(reference), 0.8);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  std::vector<std::vector<double>> values;
  for (const ParameterBlock& block : net.ParameterBlocks()) values.push_back(block.start);
  constexpr double kScale = 1.7;
  int active = 0;
  for (int cell = 0; cell < cells.count(); ++cell) {
    const CellBlocks& cell_layout = layout[static_cast<std::size_t>(cell)];
    const auto d = static_cast<Eigen::Index>(net.block_size());
    const auto size = d * static_cast<Eigen::Index>(cell_layout.blocks.size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(size, size), expected_h = h;
    Eigen::VectorXd g = Eigen::VectorXd::Zero(size), expected_g = g;
    double expected_sum = 0;
    std::vector<const double*> parameters;
    for (const int block : cell_layout.blocks)
      parameters.push_back(values[static_cast<std::size_t>(block)].data());
    for (std::size_t k = 0; k < FoldHinge::kSamples * FoldHinge::kSamples; ++k) {
      const auto& sample = hinge.samples()[static_cast<std::size_t>(cell) * 16 + k];
      ceres::DynamicAutoDiffCostFunction<HingeResidual> cost(
          new HingeResidual{BasisAt(cells, cell, sample.u, sample.v), &cell_layout, &net, sample.normal,
                            hinge.limit(), kScale});
      for (std::size_t b = 0; b < parameters.size(); ++b) cost.AddParameterBlock(static_cast<int>(d));
      cost.SetNumResiduals(1);
      double residual = 0;
      Eigen::VectorXd row(size);
      std::vector<double*> jacobians;
      for (Eigen::Index b = 0; b < size; b += d) jacobians.push_back(row.data() + b);
      ASSERT_TRUE(cost.Evaluate(parameters.data(), &residual, jacobians.data()));
      if (residual <= 0) continue;
      ++active;
      expected_h += row * row.transpose();
      expected_g += residual * row;
      expected_sum += residual * residual;
    }
    const double sum =
        hinge.AddRows(cells, cell, kScale, net, cell_layout, net.start_points(), net.start_weights(), &h, &g);
    EXPECT_NEAR(sum, expected_sum, 1e-10 * (1 + expected_sum));
    EXPECT_NEAR(hinge.SquaredResiduals(cells, cell, kScale), expected_sum, 1e-10 * (1 + expected_sum));
    const Eigen::MatrixXd upper = h.triangularView<Eigen::Upper>();
    const Eigen::MatrixXd expected_upper = expected_h.triangularView<Eigen::Upper>();
    EXPECT_LE((upper - expected_upper).norm(), 1e-9 * (1e-9 + expected_upper.norm())) << "cell " << cell;
    EXPECT_LE((g - expected_g).norm(), 1e-9 * (1e-9 + expected_g.norm())) << "cell " << cell;
  }
  EXPECT_GT(active, 20);
}

void ExpectRowsOfDefinition(SurfaceUnknowns unknowns, bool rational,
                            const std::vector<std::vector<int>>& tied) {
  const NurbsSurface reference =
      MakeSurface({.degree_u = 2, .count_u = 5, .count_v = 6, .uneven_knots = true, .rational = rational});
  ExpectRowsOfDefinition(reference, ControlNet(Crumpled(reference), unknowns, tied));
}

TEST(FoldHinge, RowsOverControlPoints_EqualAutoDiffOfTheDefinition) {
  ExpectRowsOfDefinition(SurfaceUnknowns::kControlPoints, false, {});
  ExpectRowsOfDefinition(SurfaceUnknowns::kControlPoints, true, {});
}

TEST(FoldHinge, RowsOverWeights_EqualAutoDiffOfTheDefinition) {
  ExpectRowsOfDefinition(SurfaceUnknowns::kWeights, true, {});
}

TEST(FoldHinge, RowsOverBoth_EqualAutoDiffOfTheDefinition) {
  ExpectRowsOfDefinition(SurfaceUnknowns::kBoth, true, {});
}

TEST(FoldHinge, RowsOverTiedControlPoints_EqualAutoDiffOfTheDefinition) {
  ExpectRowsOfDefinition(SurfaceUnknowns::kBoth, true, {{5, 11, 17, 23, 29}});
}

TEST(FoldHinge, RowsWithPoles_EqualAutoDiffOfTheDefinition) {
  for (const PoleEnds poles : {PoleEnds{true, false}, PoleEnds{true, true}}) {
    const NurbsSurface egg = Egg(poles);
    const ControlNet net(Crumpled(egg), SurfaceUnknowns::kControlPoints, {}, poles);
    ExpectRowsOfDefinition(egg, net);
  }
}

TEST(FoldHinge, OnAClosedReference_IsZeroAtThePolesToo) {
  const NurbsSurface egg = Egg({.begin = true, .end = true});
  const SurfaceCells cells(egg);
  const FoldHinge hinge(cells, 0.999);
  for (int cell = 0; cell < cells.count(); ++cell) EXPECT_EQ(hinge.SquaredResiduals(cells, cell, 1), 0);
  for (const auto& sample : hinge.samples()) EXPECT_GT(sample.normal.norm(), 0);
}

TEST(FoldHinge, OnItsReference_IsZeroAndFree) {
  const NurbsSurface reference = MakeSurface({.rational = true});
  const SurfaceCells cells(reference);
  const FoldHinge hinge(cells, 0.999);
  const ControlNet net(reference, SurfaceUnknowns::kControlPoints);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  EXPECT_EQ(hinge.num_samples(), 16 * cells.count());
  for (int cell = 0; cell < cells.count(); ++cell) {
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(48, 48);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(48);
    EXPECT_EQ(hinge.SquaredResiduals(cells, cell, 1), 0);
    EXPECT_EQ(hinge.AddRows(cells, cell, 1, net, layout[static_cast<std::size_t>(cell)],
                            reference.control_points(), reference.weights(), &h, &g),
              0);
    EXPECT_TRUE(h.isZero(0) && g.isZero(0));
  }
}

TEST(FoldHinge, WhereTheReferenceIsDegenerate_AsksForNothing) {
  // All control points of the first row in one place: no normal at v's begin; the rest of the hinge is
  // finite.
  WavySheet sheet{.degree_u = 1, .degree_v = 1, .count_u = 3, .count_v = 3};
  const NurbsSurface plain = MakeSurface(sheet);
  std::vector<Eigen::Vector3d> points = plain.control_points();
  for (std::size_t k : {0, 1, 3, 4}) points[k] = points[0];
  const SurfaceCells cells(NurbsSurface(plain.u(), plain.v(), points));
  const FoldHinge hinge(cells, 0.3);
  for (int cell = 0; cell < cells.count(); ++cell) EXPECT_EQ(hinge.SquaredResiduals(cells, cell, 1), 0);
  for (const auto& sample : hinge.samples()) EXPECT_TRUE(sample.normal.allFinite());
}

}  // namespace
}  // namespace frond
