// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/evaluation_callback.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/foot_point_search.h"
#include "models/surface_cells.h"
#include "problems/surface/cell_moments.h"
#include "problems/surface/control_net.h"
#include "problems/surface/distance_fit.h"
#include "problems/surface/fold_hinge.h"
#include "solvers/compressed_rows.h"

namespace frond {

// What stays the same during a solve.
struct SurfaceDistanceFit::Shared {
  Shared(std::span<const Eigen::Vector3d> points, const NurbsSurface& start, const NurbsSurface& reference,
         DistanceFitOptions options, int threads, std::vector<Eigen::Vector2d> feet);

  std::span<const Eigen::Vector3d> points;
  NurbsSurface start;
  DistanceFitOptions options;
  ControlNet net;
  SurfaceCells cells;  // of the start
  std::vector<CellBlocks> layout;
  std::vector<Eigen::MatrixXd> gram;  // thin-plate, a cell
  FoldHinge hinge;
  double hinge_scale = 0;                  // of one sample's residual
  double ridge = 0;                        // of ω²
  std::vector<std::vector<int>> ridge_of;  // the blocks (by place) whose ridge a cell carries
  std::vector<Eigen::Vector2d> start_feet;
};

// The foot points, and from them one compressed block a knot cell.
class DistanceState : public ceres::EvaluationCallback {
 public:
  DistanceState(const SurfaceDistanceFit::Shared& shared, std::vector<double*> blocks, int threads);

  // Feet are found anew at a new point, and regrouped and compressed when Jacobians are wanted. For the cost
  // alone no grouping is needed: the first cell's block then carries the cost of all points.
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  const std::vector<CompressedBlock>& cell_blocks() const { return cell_blocks_; }
  // Distances at the last evaluation.
  double squared_sum() const { return squared_sum_; }
  double squared_max() const { return squared_max_; }

 private:
  struct Foot {
    double u, v;
    std::uint32_t cell;
    bool at_edge_u, at_edge_v;
  };
  // A point's cost ρ(d²) and the weights of its rows.
  struct PointCost {
    double rho, gradient_weight, matrix_weight;
  };
  // Σ d dᵀ over a point's rows, and its residual vector S − Q.
  struct Rows {
    Eigen::Matrix3d matrix;
    Eigen::Vector3d residual;
    double weight;         // of the gradient's terms c r: ρ′
    double matrix_weight;  // of the matrix's terms c cᵀ
    double rho;
  };

  void FindFeet();
  void GroupByCell();
  void CompressCells();
  void AddMoments(std::size_t cell, CellMoments* moments, double* squared_norm) const;
  void AddAutodiffRows(std::size_t cell, CompressedRows* rows) const;
  Eigen::Vector3d LocalOrigin(std::size_t cell) const;
  void AddRoundingFloor(std::size_t cell, const Eigen::Vector3d& origin, Eigen::Index components,
                        Eigen::MatrixXd* h) const;
  void AddMomentsToBlocks(std::size_t cell, const CellMoments& moments, CompressedRows* rows) const;
  void AddRegularisation(std::size_t cell, CompressedRows* rows) const;
  double RegularisationCost(std::size_t cell) const;
  Rows PointRows(std::size_t i) const;
  PointCost CostOf(double squared_distance, bool at_edge_u, bool at_edge_v) const;
  Eigen::MatrixXd LocalControlPoints(std::size_t cell) const;

  const SurfaceDistanceFit::Shared& shared_;
  std::vector<double*> blocks_;
  int threads_;
  SurfaceCells cells_;
  FootPointOptions foot_options_;
  std::vector<Eigen::Vector3d> control_points_;
  std::vector<double> weights_;
  std::vector<Eigen::Vector2d> accepted_;  // (u, v) at the last accepted iterate
  std::vector<Foot> feet_;                 // at the present one
  std::vector<MarginRow> margin_;
  std::vector<std::uint32_t> order_;  // points, then margin rows (from points.size()), cell by cell
  std::vector<std::size_t> cell_begin_;
  std::vector<CompressedBlock> cell_blocks_;
  double points_cost_ = 0, squared_sum_ = 0, squared_max_ = 0;
};

}  // namespace frond
