// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/control_net.h"

#include <ceres/manifold.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

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

// Σ factor × the block's point. One term of factor 1 gives the point itself, to the bit.
template <typename BlockPoint>
Eigen::Vector3d PointAt(const std::vector<BlockTerm>& terms, const BlockPoint& point) {
  Eigen::Vector3d sum = terms[0].factor * point(terms[0].block);
  for (std::size_t t = 1; t < terms.size(); ++t) sum += terms[t].factor * point(terms[t].block);
  return sum;
}

}  // namespace

ControlNet::ControlNet(const NurbsSurface& start, SurfaceUnknowns unknowns,
                       const std::vector<std::vector<int>>& tied, PoleEnds poles)
    : unknowns_(unknowns), points_(start.control_points()), weights_(start.weights()) {
  const int nu = start.count_u(), nv = start.count_v();
  if (poles.any() && (unknowns != SurfaceUnknowns::kControlPoints || !start.u().periodic() ||
                      start.v().periodic() || nv < 4)) {
    throw std::logic_error("poles need a periodic u, four control points along v, and fixed weights");
  }
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
  terms_.resize(points_.size());
  std::vector<int> members;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const int j = static_cast<int>(k) % nv;
    if ((poles.begin && j < 2) || (poles.end && j >= nv - 2)) continue;
    const auto root = static_cast<std::size_t>(Root(parent, static_cast<int>(k)));
    if (root == k) {
      terms_[k] = {{num_blocks_++, 1.0}};
      block_start_.emplace_back(Eigen::Vector3d::Zero());
      members.push_back(0);
    } else {
      terms_[k] = terms_[root];
      weights_[k] = weights_[root];
    }
    const auto block = static_cast<std::size_t>(terms_[k][0].block);
    block_start_[block] += points_[k];
    ++members[block];
  }
  for (std::size_t b = 0; b < members.size(); ++b) {
    if (members[b] > 1) block_start_[b] /= members[b];
  }
  if (poles.begin) AddPole(start, 0, 1);
  if (poles.end) AddPole(start, nv - 1, nv - 2);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    points_[k] = PointAt(terms_[k], [&](int block) { return block_start_[static_cast<std::size_t>(block)]; });
  }
}

// Least squares of the start's rows: the discrete Fourier terms of order 0 and 1.
void ControlNet::AddPole(const NurbsSurface& start, int row, int next) {
  const int n = start.u().num_distinct_control_points();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), a = centre, b = centre;
  double row_weight = 0, next_weight = 0;
  const auto angle = [&](int i) { return 2 * std::numbers::pi * (i % n) / n; };
  for (int i = 0; i < n; ++i) {
    centre += start.control_point(i, row) / n;
    row_weight += start.weight(i, row) / n;
    next_weight += start.weight(i, next) / n;
    a += 2.0 / n * std::cos(angle(i)) * start.control_point(i, next);
    b += 2.0 / n * std::sin(angle(i)) * start.control_point(i, next);
  }
  const int first = num_blocks_;
  num_blocks_ += 3;
  for (const Eigen::Vector3d& value : {centre, a, b}) block_start_.push_back(value);
  for (int i = 0; i < start.count_u(); ++i) {
    const auto k = static_cast<std::size_t>(i * start.count_v());
    const std::size_t at_row = k + static_cast<std::size_t>(row),
                      at_next = k + static_cast<std::size_t>(next);
    terms_[at_row] = {{first, 1.0}};
    terms_[at_next] = {{first, 1.0}, {first + 1, std::cos(angle(i))}, {first + 2, std::sin(angle(i))}};
    weights_[at_row] = row_weight;
    weights_[at_next] = next_weight;
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
    for (const BlockTerm& term : terms_[k]) {
      const auto b = static_cast<std::size_t>(term.block);
      ParameterBlock& block = blocks[b];
      if (!block.start.empty()) continue;
      const auto share = static_cast<std::size_t>(&term - terms_[k].data());
      block.name = "control_point_" + std::to_string(k) + (share > 0 ? (share > 1 ? "_b" : "_a") : "");
      if (unknowns_ != SurfaceUnknowns::kWeights) {
        block.start.assign(block_start_[b].data(), block_start_[b].data() + 3);
      }
      if (unknowns_ != SurfaceUnknowns::kControlPoints) block.start.push_back(std::log(weights_[k]));
      SetStartBox(&block, reach);
    }
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
    if (unknowns_ != SurfaceUnknowns::kWeights) {
      (*control_points)[k] =
          PointAt(terms_[k], [&](int b) { return Eigen::Vector3d(blocks[static_cast<std::size_t>(b)]); });
    }
    if (unknowns_ != SurfaceUnknowns::kControlPoints) {
      (*weights)[k] = std::exp(blocks[static_cast<std::size_t>(terms_[k][0].block)][block_size() - 1]);
    }
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
          std::vector<BlockTerm> terms = net.terms(k);
          for (BlockTerm& term : terms) {
            const auto found = std::find(cell.blocks.begin(), cell.blocks.end(), term.block);
            const auto place = static_cast<int>(found - cell.blocks.begin());
            if (found == cell.blocks.end()) cell.blocks.push_back(term.block);
            term.block = place;
          }
          cell.terms.push_back(std::move(terms));
          cell.control_points.push_back(k);
        }
      }
      cell.plain = cell.blocks.size() == cell.control_points.size() &&
                   std::all_of(cell.terms.begin(), cell.terms.end(),
                               [](const auto& terms) { return terms.size() == 1 && terms[0].factor == 1; });
      all.push_back(std::move(cell));
    }
  }
  return all;
}

}  // namespace frond
