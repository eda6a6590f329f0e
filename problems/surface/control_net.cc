// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/control_net.h"

#include <ceres/manifold.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace frond {
namespace {

// Half-widths of the start box: of a coordinate as a share of the net's diagonal, and of a log-weight.
constexpr double kReach = 0.02, kWeightReach = 0.1;

// Union–find over control points.
int Root(std::vector<int>& parent, int k) {
  while (parent[static_cast<std::size_t>(k)] != k) k = parent[static_cast<std::size_t>(k)];
  return k;
}

void Join(std::vector<int>& parent, int a, int b) {
  a = Root(parent, a);
  b = Root(parent, b);
  parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

}  // namespace

ControlNet::ControlNet(const NurbsSurface& start, SurfaceUnknowns unknowns,
                       const std::vector<std::vector<int>>& tied)
    : unknowns_(unknowns), points_(start.control_points()), weights_(start.weights()) {
  const int nu = start.count_u(), nv = start.count_v();
  std::vector<int> parent(points_.size());
  std::iota(parent.begin(), parent.end(), 0);
  const int distinct_u = start.u().num_distinct_control_points();
  const int distinct_v = start.v().num_distinct_control_points();
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) Join(parent, i * nv + j, (i % distinct_u) * nv + j % distinct_v);
  }
  for (const auto& group : tied) {
    for (const int k : group) Join(parent, group.front(), k);
  }
  block_of_.resize(points_.size());
  std::vector<Eigen::Vector3d> sum;
  std::vector<int> members;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto root = static_cast<std::size_t>(Root(parent, static_cast<int>(k)));
    block_of_[k] = root == k ? num_blocks_++ : block_of_[root];
    sum.resize(static_cast<std::size_t>(num_blocks_), Eigen::Vector3d::Zero());
    members.resize(static_cast<std::size_t>(num_blocks_), 0);
    sum[static_cast<std::size_t>(block_of_[k])] += points_[k];
    ++members[static_cast<std::size_t>(block_of_[k])];
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto b = static_cast<std::size_t>(block_of_[k]);
    if (members[b] > 1) points_[k] = sum[b] / members[b];
    weights_[k] = weights_[static_cast<std::size_t>(Root(parent, static_cast<int>(k)))];
  }
}

int ControlNet::block_size() const {
  return unknowns_ == SurfaceUnknowns::kControlPoints ? 3 : unknowns_ == SurfaceUnknowns::kWeights ? 1 : 4;
}

void ControlNet::SetStartBox(ParameterBlock* block, double reach) const {
  for (std::size_t i = 0; i < block->start.size(); ++i) {
    const bool weight = unknowns_ != SurfaceUnknowns::kControlPoints && i + 1 == block->start.size();
    const double half = weight ? kWeightReach : reach;
    block->start_lower.push_back(block->start[i] - half);
    block->start_upper.push_back(block->start[i] + half);
  }
}

std::vector<ParameterBlock> ControlNet::ParameterBlocks() const {
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& point : points_) extent.extend(point);
  const double reach = kReach * extent.diagonal().norm();
  std::vector<ParameterBlock> blocks(static_cast<std::size_t>(num_blocks_));
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ParameterBlock& block = blocks[static_cast<std::size_t>(block_of_[k])];
    if (!block.start.empty()) continue;
    block.name = "control_point_" + std::to_string(k);
    if (unknowns_ != SurfaceUnknowns::kWeights) block.start.assign(points_[k].data(), points_[k].data() + 3);
    if (unknowns_ != SurfaceUnknowns::kControlPoints) block.start.push_back(std::log(weights_[k]));
    SetStartBox(&block, reach);
  }
  if (unknowns_ == SurfaceUnknowns::kWeights) blocks[0].constant = true;
  if (unknowns_ == SurfaceUnknowns::kBoth) {
    blocks[0].manifold = std::make_shared<ceres::SubsetManifold>(4, std::vector<int>{3});
  }
  return blocks;
}

void ControlNet::Read(const std::vector<double*>& blocks, std::vector<Eigen::Vector3d>* control_points,
                      std::vector<double>* weights) const {
  *control_points = points_;
  *weights = weights_;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double* block = blocks[static_cast<std::size_t>(block_of_[k])];
    if (unknowns_ != SurfaceUnknowns::kWeights) (*control_points)[k] = Eigen::Vector3d(block);
    if (unknowns_ != SurfaceUnknowns::kControlPoints) (*weights)[k] = std::exp(block[block_size() - 1]);
  }
}

Eigen::MatrixXd ControlNet::Tangent(const Eigen::Vector3d& control_point, double weight) const {
  if (unknowns_ == SurfaceUnknowns::kControlPoints) return weight * Eigen::Matrix3d::Identity();
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(4, block_size());
  if (unknowns_ == SurfaceUnknowns::kBoth) tangent.topLeftCorner<3, 3>().diagonal().setConstant(weight);
  tangent.rightCols<1>() << weight * control_point, weight;
  return tangent;
}

std::vector<CellBlocks> BlocksOfCells(const SurfaceCells& cells, const ControlNet& net) {
  std::vector<CellBlocks> all;
  const int p = cells.u().degree(), q = cells.v().degree(), nv = cells.basis_v().num_control_points();
  for (int ku = 0; ku < cells.u().count(); ++ku) {
    for (int kv = 0; kv < cells.v().count(); ++kv) {
      CellBlocks cell;
      for (int a = 0; a <= p; ++a) {
        for (int b = 0; b <= q; ++b) {
          const auto k = static_cast<std::size_t>((cells.u().first(ku) + a) * nv + cells.v().first(kv) + b);
          const int block = net.block_of(k);
          const auto found = std::find(cell.blocks.begin(), cell.blocks.end(), block);
          cell.place.push_back(static_cast<int>(found - cell.blocks.begin()));
          if (found == cell.blocks.end()) cell.blocks.push_back(block);
          cell.control_points.push_back(k);
        }
      }
      all.push_back(std::move(cell));
    }
  }
  return all;
}

}  // namespace frond
