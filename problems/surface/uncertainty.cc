// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/uncertainty.h"

#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "models/surface_cells.h"

namespace frond {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// The Gauss–Newton matrix of a fit at its start, over the free directions of its parameter blocks in order.
Sparse NormalMatrix(const FitProblem& fit, int threads) {
  LeastSquares least_squares(fit, threads);
  ceres::CRSMatrix rows;
  ceres::Problem::EvaluateOptions options;
  if (!least_squares.problem().Evaluate(options, nullptr, nullptr, nullptr, &rows)) {
    throw FitError("the uncertainty's normal equations cannot be evaluated");
  }
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
      rows.num_rows, rows.num_cols, static_cast<Eigen::Index>(rows.values.size()), rows.rows.data(),
      rows.cols.data(), rows.values.data());
  const Sparse columns = jacobian;
  return Sparse(columns.transpose()) * columns;
}

// ∂(block)/∂(free directions), and where these begin.
struct FreeDirections {
  std::vector<Eigen::MatrixXd> jacobian;  // a block; no columns where it is constant
  std::vector<Eigen::Index> begin;
};

FreeDirections DirectionsOf(const FitProblem& fit) {
  FreeDirections directions;
  Eigen::Index next = 0;
  for (const ParameterBlock& block : fit.parameters()) {
    const auto size = static_cast<Eigen::Index>(block.start.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(size, block.constant ? 0 : size);
    if (!block.constant && block.manifold) {
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> plus(
          size, block.manifold->TangentSize());
      block.manifold->PlusJacobian(block.start.data(), plus.data());
      jacobian = plus;
    }
    directions.begin.push_back(next);
    next += jacobian.cols();
    directions.jacobian.push_back(std::move(jacobian));
  }
  return directions;
}

}  // namespace

SurfaceUncertainty EstimateUncertainty(std::span<const Eigen::Vector3d> points, const NurbsSurface& fitted,
                                       const DistanceFitOptions& options,
                                       std::span<const Eigen::Vector2d> places,
                                       std::span<const Eigen::Vector3d> normals, int threads) {
  const SurfaceDistanceFit fit(points, fitted, fitted, options, threads);
  DistanceFitOptions data_only = options;
  data_only.fairness = data_only.hinge = data_only.weight_ridge = 0;
  data_only.margin.reset();
  const SurfaceDistanceFit data(points, fitted, fitted, data_only, threads);
  const Sparse h = NormalMatrix(fit, threads), h_data = NormalMatrix(data, threads);
  const Eigen::SimplicialLLT<Sparse> factor(h);
  if (factor.info() != Eigen::Success) {
    throw FitError("the uncertainty needs a fit that holds all its unknowns; set fit.fairness above 0");
  }
  SurfaceUncertainty result;
  const Eigen::Index unknowns = h.rows();
  constexpr Eigen::Index kColumns = 32;
  std::vector<double> traces(static_cast<std::size_t>((unknowns + kColumns - 1) / kColumns), 0);
  ParallelFor(traces.size(), 1, threads, [&](std::size_t chunk, std::size_t) {
    const Eigen::Index begin = static_cast<Eigen::Index>(chunk) * kColumns;
    const Eigen::Index count = std::min(kColumns, unknowns - begin);
    const Eigen::MatrixXd solved = factor.solve(Eigen::MatrixXd(h_data.middleCols(begin, count)));
    for (Eigen::Index k = 0; k < count; ++k) traces[chunk] += solved(begin + k, k);
  });
  for (const double trace : traces) result.degrees_of_freedom += trace;
  const std::vector<double> start = fit.StartVector();
  const double rmse = fit.Metrics(start).at("rmse"), count = static_cast<double>(points.size());
  if (!(result.degrees_of_freedom < count)) {
    throw FitError("the uncertainty needs more points than the surface has degrees of freedom");
  }
  result.noise_sigma = std::sqrt(rmse * rmse * count / (count - result.degrees_of_freedom));

  const ControlNet& net = fit.net();
  const SurfaceCells cells(fitted);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, net);
  const FreeDirections directions = DirectionsOf(fit);
  const int nu = cells.u().degree() + 1, nv = cells.v().degree() + 1, components = net.row_components();
  result.standard_deviation.resize(places.size());
  ParallelFor(places.size(), 32, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> fu(static_cast<std::size_t>(nu)), fv(static_cast<std::size_t>(nv));
    for (std::size_t i = begin; i < end; ++i) {
      const double u = places[i][0], v = places[i][1];
      const SurfaceCells::Jet1 jet = cells.Evaluate1(u, v);
      const Eigen::Vector3d& normal = normals[i];
      cells.u().Evaluate(cells.u().SpanOf(u), u, 0, fu.data());
      cells.v().Evaluate(cells.v().SpanOf(v), v, 0, fv.data());
      Eigen::Vector4d homogeneous;  // n · ∂S/∂(wP, w) over the basis function
      homogeneous << normal, -normal.dot(jet.position);
      const CellBlocks& cell = layout[static_cast<std::size_t>(cells.CellOf(u, v))];
      Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
      for (std::size_t k = 0; k < cell.control_points.size(); ++k) {
        const std::size_t point = cell.control_points[k];
        const double basis = fu[k / static_cast<std::size_t>(nv)] * fv[k % static_cast<std::size_t>(nv)] /
                             cells.Denominator(u, v);
        const Eigen::VectorXd by_block =
            net.Tangent(net.start_points()[point], cells.rational() ? net.start_weights()[point] : 1.0)
                .transpose() *
            homogeneous.head(components);
        for (const BlockTerm& term : net.terms(point)) {
          const auto block = static_cast<std::size_t>(term.block);
          const Eigen::MatrixXd& free = directions.jacobian[block];
          row.segment(directions.begin[block], free.cols()) +=
              basis * term.factor * (free.transpose() * by_block);
        }
      }
      const Eigen::VectorXd moved = factor.solve(row);
      result.standard_deviation[i] = result.noise_sigma * std::sqrt(std::max(0.0, moved.dot(h_data * moved)));
    }
  });
  return result;
}

double AreaMean(const SurfaceMesh& mesh, std::span<const double> value) {
  double sum = 0, area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
               k = static_cast<std::size_t>(c);
    const double piece =
        (mesh.vertices[j] - mesh.vertices[i]).cross(mesh.vertices[k] - mesh.vertices[i]).norm();
    sum += piece * (value[i] + value[j] + value[k]) / 3;
    area += piece;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace frond
