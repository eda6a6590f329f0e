// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/nurbs_surface.h"
#include "models/surface_cells.h"
#include "solvers/fit_problem.h"

namespace frond {

enum class SurfaceUnknowns { kControlPoints, kWeights, kBoth };

// A share of a control point: factor × the values of a parameter block.
struct BlockTerm {
  int block = 0;
  double factor = 1;
};

// How a surface's control net hangs on a solver's parameter blocks. A block is a control point (3 values), a
// log-weight ω with w = e^ω (1), or both (x, y, z, ω). Control points that have to stay equal, the repeats of
// a periodic direction and rows tied to one point (a leaf's tip), share one block.
//
// At a pole (an end of v where u closes round one point) the surface is kept C¹ by three blocks P₀, A, B for
// the end's two rows of control points (MATH.md §1, "Closed with poles"): with n distinct ones along u,
//   row 0 = P₀,   row 1, control point i = P₀ + cos(2πi/n) A + sin(2πi/n) B,
// so that the tangent plane there is that of A and B. Each control point is a sum of BlockTerms.
//
// In homogeneous coordinates (wP, w) a distance row is linear over the rational denominator; Tangent(k) is
// the matrix ∂(w_k P_k, w_k)/∂(block of k) that brings such a row to the block's own values (MATH.md §1,
// "Weights").
class ControlNet {
 public:
  // `tied`: groups of control point indices (i * count_v + j) that are one point. Their mean is the start.
  // `poles`: u must be periodic, v not and of at least 4 control points, and the unknowns control points only
  // (std::logic_error); the rows' weights become their mean.
  ControlNet(const NurbsSurface& start, SurfaceUnknowns unknowns,
             const std::vector<std::vector<int>>& tied = {}, PoleEnds poles = {});

  SurfaceUnknowns unknowns() const { return unknowns_; }
  int num_blocks() const { return num_blocks_; }
  int block_size() const;  // 3, 1 or 4
  int row_components() const { return unknowns_ == SurfaceUnknowns::kControlPoints ? 3 : 4; }
  // The terms that add up to a control point; one of factor 1 away from poles.
  const std::vector<BlockTerm>& terms(std::size_t control_point) const { return terms_[control_point]; }

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
  void AddPole(const NurbsSurface& start, int row, int next);
  void SetStartBox(ParameterBlock* block, double reach) const;

  SurfaceUnknowns unknowns_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> weights_;
  std::vector<std::vector<BlockTerm>> terms_;
  std::vector<Eigen::Vector3d> block_start_;  // of its point
  int num_blocks_ = 0;
};

// The blocks under one knot cell: each once, and for each of its (p + 1)(q + 1) control points (index
// a (q + 1) + b) its number and its terms, whose `block` is the place in `blocks`.
struct CellBlocks {
  std::vector<int> blocks;
  std::vector<std::vector<BlockTerm>> terms;
  std::vector<std::size_t> control_points;
  bool plain = false;  // one block a control point, in their order
};
std::vector<CellBlocks> BlocksOfCells(const SurfaceCells& cells, const ControlNet& net);

}  // namespace frond
