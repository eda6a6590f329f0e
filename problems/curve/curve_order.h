// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace frond {

// A polygon along unordered points of one curve: the averages of small cells, in the order of the curve.
struct PointChain {
  std::vector<Eigen::Vector3d> vertices;  // at least 2
  bool closed = false;                    // the last is followed by the first
};

// Cells of growing size (from about twice the points' spacing), until their averages' minimum spanning tree
// is a chain: until its longest path holds 95 % of them. So cells outgrow the noise by themselves. The curve
// must not cross itself or come as near to itself as the noise is wide. `closed`: whether it is; nullopt:
// where the ends of the chain are as near as neighbours. Throws InputError for less than two different
// points, and where no size of cell makes the tree a chain, or a stretch of it between gaps closes in itself:
// the points branch or are in parts.
PointChain FindChain(std::span<const Eigen::Vector3d> points, std::optional<bool> closed);

// Whether points in order close: the way from the last to the first is at most `gap` median steps.
bool LooksClosed(std::span<const Eigen::Vector3d> points, double gap = 2);

// Where along the polygon each point projects: [0, 1], for a closed chain [0, 1).
std::vector<double> ProjectOnChain(std::span<const Eigen::Vector3d> points, const PointChain& chain);

}  // namespace frond
