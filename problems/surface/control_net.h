// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/nurbs_surface.h"
#include "models/surface_cells.h"
#include "solvers/fit_problem.h"

namespace frond {

enum class SurfaceUnknowns { kControlPoints, kWeights, kBoth };

// How a surface's control net hangs on a solver's parameter blocks. A block is a control point (3 values), a
// log-weight ω with w = e^ω (1), or both (x, y, z, ω). Control points that have to stay equal, the repeats of
// a periodic direction and rows tied to one point (a leaf's tip), share one block.
//
// In homogeneous coordinates (wP, w) a distance row is linear over the rational denominator; Tangent(k) is
// the matrix ∂(w_k P_k, w_k)/∂(block of k) that brings such a row to the block's own values (MATH.md §1,
// "Weights").
class ControlNet {
 public:
  // `tied`: groups of control point indices (i * count_v + j) that are one point. Their mean is the start.
  ControlNet(const NurbsSurface& start, SurfaceUnknowns unknowns,
             const std::vector<std::vector<int>>& tied = {});

  SurfaceUnknowns unknowns() const { return unknowns_; }
  int num_blocks() const { return num_blocks_; }
  int block_size() const;  // 3, 1 or 4
  int row_components() const { return unknowns_ == SurfaceUnknowns::kControlPoints ? 3 : 4; }
  int block_of(std::size_t control_point) const { return block_of_[control_point]; }

  // Start values; the first weight is held constant where weights are free (their common scale is a gauge).
  // Starts are drawn about them, within 2 % of the net's diagonal and, in ω, 0.1.
  std::vector<ParameterBlock> ParameterBlocks() const;

  // Control points and weights of the values in `blocks`.
  void Read(const std::vector<double*>& blocks, std::vector<Eigen::Vector3d>* control_points,
            std::vector<double>* weights) const;

  // row_components() × block_size(); for control points alone the first three rows of it.
  Eigen::MatrixXd Tangent(const Eigen::Vector3d& control_point, double weight) const;

  const std::vector<Eigen::Vector3d>& start_points() const { return points_; }
  const std::vector<double>& start_weights() const { return weights_; }

 private:
  void SetStartBox(ParameterBlock* block, double reach) const;

  SurfaceUnknowns unknowns_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> weights_;
  std::vector<int> block_of_;
  int num_blocks_ = 0;
};

// The blocks under one knot cell: each once, and the place among them of each of its (p + 1)(q + 1) control
// points (index a (q + 1) + b).
struct CellBlocks {
  std::vector<int> blocks;
  std::vector<int> place;
  std::vector<std::size_t> control_points;
};
std::vector<CellBlocks> BlocksOfCells(const SurfaceCells& cells, const ControlNet& net);

}  // namespace frond
