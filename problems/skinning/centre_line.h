// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace frond {

// A line through the middle of an object, as a polyline of short steps by arc length; it goes on straight
// beyond its ends.
class CentreLine {
 public:
  // At least two nodes, no two neighbours equal.
  explicit CentreLine(std::vector<Eigen::Vector3d> nodes);

  double length() const { return lengths_.back(); }  // from 0 at the first node to the last node
  Eigen::Vector3d At(double s) const;
  Eigen::Vector3d Tangent(double s) const;            // unit
  double Locate(const Eigen::Vector3d& point) const;  // s of the nearest point of the line

 private:
  std::size_t SegmentOf(double s) const;

  std::vector<Eigen::Vector3d> nodes_, tangents_;  // tangents at the nodes
  std::vector<double> lengths_;
};

// The line through the points' mean along `direction` (any length but 0), from the first point's foot to the
// last one's.
CentreLine StraightLine(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& direction);

// The centre line of a tube that may bend. The points are ordered by the first eigenvector, after the
// constant one, of the Laplacian of their graph of nearest neighbours, which runs along a long object and is
// even across it; the middles of equal steps of it are smoothed by a cubic B-spline curve, and both are
// repeated with slabs across the line found so far. Meant for objects longer than half their girth. Throws
// InputError where less than nine tenths of the points hang together.
CentreLine FindCentreLine(std::span<const Eigen::Vector3d> points);

}  // namespace frond
