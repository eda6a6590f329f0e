// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/distance_state.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "problems/surface/distance_residual.h"
#include "problems/surface/thin_plate.h"

namespace frond {
namespace {

constexpr std::size_t kPointChunk = 1024;
constexpr double kRoundingFloor = 1e-13;  // of H's mean diagonal

// The unit directions along which a point's residual counts, one a row, from Σ d dᵀ (a projection).
Eigen::Matrix<double, Eigen::Dynamic, 3> DirectionsOf(const Eigen::Matrix3d& projection) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(projection);
  const Eigen::Index rank = (eigen.eigenvalues().array() > 0.5).count();
  return eigen.eigenvectors().rightCols(rank).transpose();
}

// The blocks of H, on and above its diagonal, that the entry of control points a and b of a cell goes to.
template <typename Add>
void ForUpperBlocks(const CellBlocks& layout, Eigen::Index a, Eigen::Index b, const Add& add) {
  for (const BlockTerm& row : layout.terms[static_cast<std::size_t>(a)]) {
    for (const BlockTerm& column : layout.terms[static_cast<std::size_t>(b)]) {
      if (column.block >= row.block) add(row.block, column.block, row.factor * column.factor);
    }
  }
}

}  // namespace

SurfaceDistanceFit::Shared::Shared(std::span<const Eigen::Vector3d> points_in, const NurbsSurface& start_in,
                                   const NurbsSurface& reference, DistanceFitOptions options_in, int threads,
                                   std::vector<Eigen::Vector2d> feet)
    : points(points_in),
      start(start_in),
      options(std::move(options_in)),
      net(start, options.unknowns, options.tied, options.poles),
      cells(start),
      layout(BlocksOfCells(cells, net)),
      gram(ThinPlateGram(cells, options.poles, options.membrane)),
      hinge(SurfaceCells(reference), options.hinge_limit),
      start_feet(std::move(feet)) {
  cells.Update(net.start_points(), net.start_weights());
  const double n = static_cast<double>(points.size());
  hinge_scale = options.length_scale * std::sqrt(options.hinge * n / hinge.num_samples());
  ridge_of.resize(layout.size());
  if (options.unknowns != SurfaceUnknowns::kControlPoints) {
    ridge = options.weight_ridge * n * options.length_scale * options.length_scale;
    std::vector<bool> carried(static_cast<std::size_t>(net.num_blocks()), false);
    for (std::size_t c = 0; c < layout.size(); ++c) {
      for (std::size_t k = 0; k < layout[c].blocks.size(); ++k) {
        const auto block = static_cast<std::size_t>(layout[c].blocks[k]);
        if (!carried[block]) ridge_of[c].push_back(static_cast<int>(k));
        carried[block] = true;
      }
    }
  }
  if (start_feet.size() == points.size()) return;
  start_feet.resize(points.size());
  const FootPointSearch search(cells);
  ParallelFor(points.size(), kPointChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FootPoint foot = search.Find(points[i]);
      start_feet[i] = {foot.u, foot.v};
    }
  });
}

DistanceState::DistanceState(const SurfaceDistanceFit::Shared& shared, std::vector<double*> blocks,
                             int threads)
    : shared_(shared),
      blocks_(std::move(blocks)),
      threads_(threads),
      cells_(shared.cells),
      accepted_(shared.start_feet),
      feet_(shared.points.size()),
      cell_blocks_(shared.layout.size()) {
  foot_options_.step_tolerance = 1e-6 * shared.start.Size();
}

void DistanceState::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (new_evaluation_point) {
    shared_.net.Read(blocks_, &control_points_, &weights_);
    cells_.Update(control_points_, weights_);
    FindFeet();
    if (shared_.options.margin) {
      margin_ = MakeMarginRows(cells_, *shared_.options.margin, shared_.points.size());
    }
  }
  if (evaluate_jacobians) {
    for (std::size_t i = 0; i < feet_.size(); ++i) accepted_[i] = {feet_[i].u, feet_[i].v};
    GroupByCell();
    CompressCells();
  } else if (new_evaluation_point) {
    double margin_cost = 0;
    for (const MarginRow& row : margin_) {
      const Eigen::Vector3d r = cells_.Evaluate(row.u, row.v) - row.target;
      margin_cost += row.weight * r.dot(row.matrix * r);
    }
    for (std::size_t c = 0; c < cell_blocks_.size(); ++c) {
      SetCostOnly(RegularisationCost(c) + (c == 0 ? points_cost_ + margin_cost : 0), &cell_blocks_[c]);
    }
  }
}

void DistanceState::FindFeet() {
  const std::size_t n = feet_.size();
  struct Sums {
    double rho = 0, squared = 0, max = 0;
  };
  std::vector<Sums> chunks((n + kPointChunk - 1) / kPointChunk);
  ParallelFor(n, kPointChunk, threads_, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const FootPoint foot =
          RefineFootPoint(cells_, shared_.points[i], accepted_[i][0], accepted_[i][1], foot_options_);
      feet_[i] = {foot.u, foot.v, static_cast<std::uint32_t>(cells_.CellOf(foot.u, foot.v)), foot.at_edge_u,
                  foot.at_edge_v};
      sums.rho += CostOf(foot.squared_distance, foot.at_edge_u, foot.at_edge_v).rho;
      sums.squared += foot.squared_distance;
      sums.max = std::max(sums.max, foot.squared_distance);
    }
    chunks[begin / kPointChunk] = sums;
  });
  points_cost_ = squared_sum_ = squared_max_ = 0;
  for (const Sums& sums : chunks) {
    points_cost_ += sums.rho;
    squared_sum_ += sums.squared;
    squared_max_ = std::max(squared_max_, sums.max);
  }
}

void DistanceState::GroupByCell() {
  const std::size_t n = feet_.size(), total = n + margin_.size();
  const auto cell_of = [&](std::size_t i) {
    return i < n ? feet_[i].cell
                 : static_cast<std::uint32_t>(cells_.CellOf(margin_[i - n].u, margin_[i - n].v));
  };
  cell_begin_.assign(cell_blocks_.size() + 1, 0);
  for (std::size_t i = 0; i < total; ++i) ++cell_begin_[cell_of(i) + 1];
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  order_.resize(total);
  for (std::size_t i = 0; i < total; ++i) order_[next[cell_of(i)]++] = static_cast<std::uint32_t>(i);
}

void DistanceState::CompressCells() {
  const int p = cells_.u().degree(), q = cells_.v().degree(), components = shared_.net.row_components();
  ParallelFor(cell_blocks_.size(), 1, threads_, [&](std::size_t cell, std::size_t) {
    CompressedRows rows(static_cast<int>(shared_.layout[cell].blocks.size()) * shared_.net.block_size());
    if (shared_.options.derivatives == DistanceDerivatives::kAutodiff) {
      AddAutodiffRows(cell, &rows);
    } else {
      CellMoments moments(p, q, components, components);
      AddMoments(cell, &moments, &rows.squared_norm());
      AddMomentsToBlocks(cell, moments, &rows);
    }
    AddRegularisation(cell, &rows);
    rows.Compress(&cell_blocks_[cell]);
  });
}

// With emphasis the residual is √ρ itself, ρ = s (1 + β s / c²), s = d²: its gradient is ρ′ d ∂d, its
// Gauss–Newton matrix (ρ′² s / ρ) ∂d ∂dᵀ. With a robust loss the rows are weighted by ρ′, as Ceres does.
DistanceState::PointCost DistanceState::CostOf(double squared_distance, bool at_edge_u,
                                               bool at_edge_v) const {
  const DistanceFitOptions& options = shared_.options;
  const double edge = options.margin && (at_edge_u || at_edge_v) ? options.margin->outside_weight : 1;
  if (options.peak_emphasis > 0) {
    const double t = options.peak_emphasis * squared_distance / (options.peak_scale * options.peak_scale);
    const double derivative = 1 + 2 * t;
    return {edge * squared_distance * (1 + t), edge * derivative, edge * derivative * derivative / (1 + t)};
  }
  const RobustLoss::Value loss = options.loss(squared_distance);
  return {edge * loss.rho, edge * loss.derivative, edge * loss.derivative};
}

// MATH.md §1: one row along the normal inside, two square to the tangent on an edge, three in a corner; three
// too while the foot is not square to the surface, or LM takes false progress for true.
DistanceState::Rows DistanceState::PointRows(std::size_t i) const {
  const std::size_t n = feet_.size();
  if (i >= n) {
    const MarginRow& row = margin_[i - n];
    const Eigen::Vector3d r = cells_.Evaluate(row.u, row.v) - row.target;
    return {row.matrix, r, row.weight, row.weight, row.weight * r.dot(row.matrix * r)};
  }
  const Foot& foot = feet_[i];
  const SurfaceCells::Jet1 jet = cells_.Evaluate1(foot.u, foot.v);
  Rows rows;
  rows.residual = jet.position - shared_.points[i];
  const double squared = rows.residual.squaredNorm();
  const PointCost cost = CostOf(squared, foot.at_edge_u, foot.at_edge_v);
  rows.weight = cost.gradient_weight;
  rows.matrix_weight = cost.matrix_weight;
  rows.rho = cost.rho;
  Eigen::Vector3d normal = jet.du.cross(jet.dv);
  const double length = normal.squaredNorm();
  if (foot.at_edge_u != foot.at_edge_v) {
    const Eigen::Vector3d& tangent = foot.at_edge_u ? jet.dv : jet.du;
    const double tangent_squared = tangent.squaredNorm();
    rows.matrix.setIdentity();
    if (tangent_squared > 0) rows.matrix -= tangent * tangent.transpose() / tangent_squared;
  } else if (!foot.at_edge_u && length > 0) {
    rows.matrix = normal * normal.transpose() / length;
  } else {
    rows.matrix.setIdentity();
  }
  const double along = squared - rows.residual.dot(rows.matrix * rows.residual);
  const double tiny = foot_options_.step_tolerance * 1e-3;
  if (along > 1e-6 * squared + tiny * tiny) rows.matrix.setIdentity();
  return rows;
}

void DistanceState::AddMoments(std::size_t cell, CellMoments* moments, double* squared_norm) const {
  const SpanPolynomials &su = cells_.u(), &sv = cells_.v();
  const int ku = static_cast<int>(cell) / sv.count(), kv = static_cast<int>(cell) % sv.count();
  const double iu = 1 / su.length(ku), iv = 1 / sv.length(kv);
  const bool homogeneous = shared_.net.row_components() == 4;
  const Eigen::Vector3d origin = LocalOrigin(cell);
  for (std::size_t o = cell_begin_[cell]; o < cell_begin_[cell + 1]; ++o) {
    const std::size_t i = order_[o];
    const double u = i < feet_.size() ? feet_[i].u : margin_[i - feet_.size()].u;
    const double v = i < feet_.size() ? feet_[i].v : margin_[i - feet_.size()].v;
    const Rows rows = PointRows(i);
    *squared_norm += rows.rho;
    const double inverse = 1 / cells_.Denominator(u, v);
    const Eigen::Matrix3d m = (rows.matrix_weight * inverse * inverse) * rows.matrix;
    const Eigen::Vector3d g = (rows.weight * inverse) * (rows.matrix * rows.residual);
    const double s = (u - su.begin(ku)) * iu, t = (v - sv.begin(kv)) * iv;
    if (!homogeneous) {
      const double matrix[6] = {m(0, 0), m(1, 0), m(1, 1), m(2, 0), m(2, 1), m(2, 2)};
      moments->Add(s, t, matrix, g.data());
    } else {  // c = (d, −d·S), S from the cell's own origin: H's weight entries are differences of |S|²
      const Eigen::Vector3d position = cells_.Evaluate(u, v) - origin, ms = m * position;
      const double matrix[10] = {m(0, 0), m(1, 0), m(1, 1), m(2, 0), m(2, 1),
                                 m(2, 2), -ms[0],  -ms[1],  -ms[2],  position.dot(ms)};
      const double vector[4] = {g[0], g[1], g[2], -position.dot(g)};
      moments->Add(s, t, matrix, vector);
    }
  }
}

Eigen::Vector3d DistanceState::LocalOrigin(std::size_t cell) const {
  const auto& members = shared_.layout[cell].control_points;
  return control_points_[members[members.size() / 2]];
}

// H is a difference of large sums where a function is near zero at all of the cell's points (MATH.md §1, the
// ε of the compressed blocks): lifts its diagonal above that rounding, the weights' by the square of their
// lever.
void DistanceState::AddRoundingFloor(std::size_t cell, const Eigen::Vector3d& origin, Eigen::Index components,
                                     Eigen::MatrixXd* h) const {
  double mean = 0, lever = 0;
  const auto& members = shared_.layout[cell].control_points;
  for (Eigen::Index k = 0; k < h->rows(); ++k) mean += k % components < 3 ? (*h)(k, k) : 0;
  mean /= 3 * static_cast<double>(members.size());
  for (const std::size_t k : members) lever = std::max(lever, (control_points_[k] - origin).squaredNorm());
  for (Eigen::Index k = 0; k < h->rows(); ++k) {
    (*h)(k, k) += kRoundingFloor * mean * (k % components < 3 ? 1 : lever);
  }
}

void DistanceState::AddMomentsToBlocks(std::size_t cell, const CellMoments& moments,
                                       CompressedRows* rows) const {
  const SpanPolynomials &su = cells_.u(), &sv = cells_.v();
  const CellBlocks& layout = shared_.layout[cell];
  const Eigen::Index c = shared_.net.row_components(), d = shared_.net.block_size();
  const auto local = static_cast<Eigen::Index>(layout.terms.size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(c * local, c * local);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(c * local);
  moments.AddTo(su.coefficients(static_cast<int>(cell) / sv.count()),
                sv.coefficients(static_cast<int>(cell) % sv.count()), &h, &g);
  const Eigen::Vector3d origin = LocalOrigin(cell);
  AddRoundingFloor(cell, origin, c, &h);
  if (layout.plain && d == 3 &&
      !cells_
           .rational()) {  // every tangent is the identity and the blocks stand in the control points' order
    rows->AddMatrix(h, g, 0);
    return;
  }
  std::vector<Eigen::MatrixXd> tangents;
  for (const std::size_t k : layout.control_points) {
    tangents.push_back(
        shared_.net.Tangent(control_points_[k] - origin, cells_.rational() ? weights_[k] : 1.0));
  }
  for (Eigen::Index a = 0; a < local; ++a) {
    const Eigen::MatrixXd& ta = tangents[static_cast<std::size_t>(a)];
    const Eigen::VectorXd ga = ta.transpose() * g.segment(a * c, c);
    for (const BlockTerm& row : layout.terms[static_cast<std::size_t>(a)]) {
      rows->g().segment(row.block * d, d) += row.factor * ga;
    }
    for (Eigen::Index b = 0; b < local; ++b) {
      const Eigen::MatrixXd hab =
          ta.transpose() * h.block(a * c, b * c, c, c) * tangents[static_cast<std::size_t>(b)];
      ForUpperBlocks(layout, a, b, [&](int row, int column, double factor) {
        rows->H().block(row * d, column * d, d, d) += factor * hab;
      });
    }
  }
}

void DistanceState::AddAutodiffRows(std::size_t cell, CompressedRows* rows) const {
  const SpanPolynomials &su = cells_.u(), &sv = cells_.v();
  const int ku = static_cast<int>(cell) / sv.count(), kv = static_cast<int>(cell) % sv.count();
  const CellBlocks& layout = shared_.layout[cell];
  const int d = shared_.net.block_size(), nu = su.degree() + 1, nv = sv.degree() + 1;
  std::vector<const double*> parameters;
  for (const int block : layout.blocks) parameters.push_back(blocks_[static_cast<std::size_t>(block)]);
  std::vector<double> fu(static_cast<std::size_t>(nu)), fv(static_cast<std::size_t>(nv)), basis;
  std::vector<double> row(static_cast<std::size_t>(rows->num_parameters()));
  for (std::size_t o = cell_begin_[cell]; o < cell_begin_[cell + 1]; ++o) {
    const std::size_t i = order_[o];
    const bool is_point = i < feet_.size();
    const double u = is_point ? feet_[i].u : margin_[i - feet_.size()].u;
    const double v = is_point ? feet_[i].v : margin_[i - feet_.size()].v;
    su.Evaluate(ku, u, 0, fu.data());
    sv.Evaluate(kv, v, 0, fv.data());
    basis.clear();
    for (const double a : fu) {
      for (const double b : fv) basis.push_back(a * b);
    }
    const Rows point_rows = PointRows(i);
    const auto directions = DirectionsOf(point_rows.matrix);
    const Eigen::Vector3d target = is_point ? shared_.points[i] : margin_[i - feet_.size()].target;
    ceres::DynamicAutoDiffCostFunction<DistanceResidual> cost(
        new DistanceResidual{basis, &layout, &shared_.net, target, directions});
    for (std::size_t k = 0; k < layout.blocks.size(); ++k) cost.AddParameterBlock(d);
    cost.SetNumResiduals(static_cast<int>(directions.rows()));
    Eigen::VectorXd residuals(directions.rows());
    std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobians(
        layout.blocks.size(), Eigen::MatrixXd(directions.rows(), d));
    std::vector<double*> pointers;
    for (auto& jacobian : jacobians) pointers.push_back(jacobian.data());
    cost.Evaluate(parameters.data(), residuals.data(), pointers.data());
    for (Eigen::Index r = 0; r < directions.rows(); ++r) {
      for (std::size_t k = 0; k < jacobians.size(); ++k) {
        for (int x = 0; x < d; ++x)
          row[k * static_cast<std::size_t>(d) + static_cast<std::size_t>(x)] = jacobians[k](r, x);
      }
      const double ratio = point_rows.matrix_weight > 0 ? point_rows.weight / point_rows.matrix_weight : 0;
      rows->AddWeightedRow(row, ratio * residuals[r], point_rows.matrix_weight, r == 0 ? point_rows.rho : 0);
    }
  }
}

Eigen::MatrixXd DistanceState::LocalControlPoints(std::size_t cell) const {
  const auto& members = shared_.layout[cell].control_points;
  Eigen::MatrixXd local(static_cast<Eigen::Index>(members.size()), 3);
  for (std::size_t k = 0; k < members.size(); ++k) {
    local.row(static_cast<Eigen::Index>(k)) = control_points_[members[k]].transpose();
  }
  return local;
}

void DistanceState::AddRegularisation(std::size_t cell, CompressedRows* rows) const {
  const CellBlocks& layout = shared_.layout[cell];
  const Eigen::Index d = shared_.net.block_size();
  if (d >= 3) {
    const double scale = shared_.options.fairness * static_cast<double>(shared_.points.size());
    const Eigen::MatrixXd points = LocalControlPoints(cell), gradient = scale * shared_.gram[cell] * points;
    for (Eigen::Index a = 0; a < points.rows(); ++a) {
      for (const BlockTerm& row : layout.terms[static_cast<std::size_t>(a)]) {
        rows->g().segment<3>(row.block * d) += row.factor * gradient.row(a).transpose();
      }
      for (Eigen::Index b = 0; b < points.rows(); ++b) {
        const double entry = scale * shared_.gram[cell](a, b);
        ForUpperBlocks(layout, a, b, [&](int row, int column, double factor) {
          rows->H().block<3, 3>(row * d, column * d).diagonal().array() += factor * entry;
        });
      }
    }
    rows->squared_norm() += gradient.cwiseProduct(points).sum();
  }
  if (shared_.hinge_scale > 0) {
    rows->squared_norm() +=
        shared_.hinge.AddRows(cells_, static_cast<int>(cell), shared_.hinge_scale, shared_.net, layout,
                              control_points_, weights_, &rows->H(), &rows->g());
  }
  for (const int place : shared_.ridge_of[cell]) {
    const Eigen::Index k = place * d + d - 1;
    const double omega =
        blocks_[static_cast<std::size_t>(layout.blocks[static_cast<std::size_t>(place)])][d - 1];
    rows->H()(k, k) += shared_.ridge;
    rows->g()[k] += shared_.ridge * omega;
    rows->squared_norm() += shared_.ridge * omega * omega;
  }
}

double DistanceState::RegularisationCost(std::size_t cell) const {
  const Eigen::Index d = shared_.net.block_size();
  double cost = 0;
  if (d >= 3) {
    const double scale = shared_.options.fairness * static_cast<double>(shared_.points.size());
    const Eigen::MatrixXd points = LocalControlPoints(cell);
    cost += scale * (shared_.gram[cell] * points).cwiseProduct(points).sum();
  }
  if (shared_.hinge_scale > 0) {
    cost += shared_.hinge.SquaredResiduals(cells_, static_cast<int>(cell), shared_.hinge_scale);
  }
  for (const int place : shared_.ridge_of[cell]) {
    const double omega =
        blocks_[static_cast<std::size_t>(shared_.layout[cell].blocks[static_cast<std::size_t>(place)])]
               [d - 1];
    cost += shared_.ridge * omega * omega;
  }
  return cost;
}

}  // namespace frond
