// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/linear_start.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "problems/surface/cell_moments.h"
#include "problems/surface/control_net.h"
#include "problems/surface/thin_plate.h"

namespace frond {
NurbsSurface FitAtParameters(std::span<const Eigen::Vector3d> points,
                             std::span<const Eigen::Vector2d> parameters, const BSplineBasis& u,
                             const BSplineBasis& v, double fairness, PoleEnds poles) {
  const auto count = static_cast<std::size_t>(u.num_control_points() * v.num_control_points());
  const NurbsSurface blank(u, v, std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::Zero()));
  const SurfaceCells cells(blank);
  const ControlNet net(blank, SurfaceUnknowns::kControlPoints, {}, poles);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  std::vector<CellMoments> sums(layout.size(), CellMoments(u.degree(), v.degree(), 1, 3));
  const double one = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int ku = cells.u().SpanOf(parameters[i][0]), kv = cells.v().SpanOf(parameters[i][1]);
    const double s = (parameters[i][0] - cells.u().begin(ku)) / cells.u().length(ku);
    const double t = (parameters[i][1] - cells.v().begin(kv)) / cells.v().length(kv);
    sums[static_cast<std::size_t>(ku * cells.v().count() + kv)].Add(s, t, &one, points[i].data());
  }
  const std::vector<Eigen::MatrixXd> gram = ThinPlateGram(cells, poles);
  const Eigen::Index size = static_cast<Eigen::Index>(net.num_blocks());
  const Eigen::Index local = (u.degree() + 1) * (v.degree() + 1);
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(size, 3);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(layout.size() * static_cast<std::size_t>(local * local));
  for (std::size_t c = 0; c < layout.size(); ++c) {
    const int ku = static_cast<int>(c) / cells.v().count(), kv = static_cast<int>(c) % cells.v().count();
    Eigen::MatrixXd h = fairness * static_cast<double>(points.size()) * gram[c];
    Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * local);
    sums[c].AddTo(cells.u().coefficients(ku), cells.v().coefficients(kv), &h, &g);
    for (Eigen::Index a = 0; a < local; ++a) {
      for (const BlockTerm& row : net.terms(layout[c].control_points[static_cast<std::size_t>(a)])) {
        rhs.row(row.block) += row.factor * g.segment<3>(3 * a).transpose();
        for (Eigen::Index b = 0; b < local; ++b) {
          for (const BlockTerm& column : net.terms(layout[c].control_points[static_cast<std::size_t>(b)])) {
            if (column.block > row.block) continue;
            entries.emplace_back(row.block, column.block, row.factor * column.factor * h(a, b));
          }
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success)
    throw FitError("the linear start is singular: too few points for the net");
  const Eigen::MatrixXd solution = factor.solve(rhs);
  if (!solution.allFinite()) throw FitError("the linear start is singular: too few points for the net");
  std::vector<Eigen::Vector3d> control_points(count);
  for (std::size_t k = 0; k < count; ++k) {
    control_points[k].setZero();
    for (const BlockTerm& term : net.terms(k)) {
      control_points[k] += term.factor * solution.row(term.block).transpose();
    }
  }
  return NurbsSurface(u, v, std::move(control_points));
}

}  // namespace frond
