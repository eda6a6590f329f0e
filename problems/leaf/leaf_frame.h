// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

struct LeafFrameOptions {
  bool leave_out_strays = true;  // points not connected with the sheet (StrayPoints) have no say in the frame
};

// The standard position of Wu et al. 2021, section 2.3.1: origin in the mean of the points, x along the first
// principal direction, y the second, z the third. Their signs, which the paper leaves open, follow the shape:
//
//   x  from the blunt end (base, petiole) to the pointed one (tip). Each end is judged by the sheet's mean
//      width over its outermost part; an end that stops wider than a base does is a tip cut off, and the
//      other end then decides (only from 20,000 points on, and not for a cut of the last few per cent);
//   z  to the side where the blade bulges across (the middle above the margins: the midrib's side on a
//      hill-shaped leaf, "the underside looks like a hill"); on a blade hardly bent across, along;
//   y  = z × x, to the left of one who looks from the base to the tip with z up.
//
// So the same leaf in any pose, unit or point order has the same frame on it.
struct LeafFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns x, y, z in input coordinates; right-handed
  double length = 0;                                   // L: extent along x of the points that count
  double width = 0;                                    // extent along y
  std::vector<std::size_t> strays;                     // indices of the points left out, rising

  Eigen::Vector3d FromInput(const Eigen::Vector3d& p) const { return axes.transpose() * (p - origin); }
  Eigen::Vector3d ToInput(const Eigen::Vector3d& p) const { return axes * p + origin; }
};

// Throws InputError where fewer than 10 points are left, or they have no extent in two directions.
LeafFrame FindLeafFrame(std::span<const Eigen::Vector3d> points, const LeafFrameOptions& options = {});

// The points that count (no strays) in frame coordinates, in their order.
std::vector<Eigen::Vector3d> PointsInFrame(std::span<const Eigen::Vector3d> points, const LeafFrame& frame);

}  // namespace frond
