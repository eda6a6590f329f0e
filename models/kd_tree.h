// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace frond {

// Nearest neighbours among fixed points (nanoflann behind a small wall). Queries are re-entrant; ties go to
// the lower index as far as the tree's order allows, so an answer depends on the points alone.
class KdTree {
 public:
  struct Neighbour {
    std::size_t index = 0;
    double squared_distance = 0;
  };

  explicit KdTree(std::span<const Eigen::Vector3d> points);  // keeps a view: the points must outlive the tree
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  std::size_t size() const;
  Neighbour Nearest(const Eigen::Vector3d& query) const;  // size() > 0
  // Up to out.size() (at most 64) nearest within `reach`, closest first; returns how many there are.
  std::size_t Nearest(const Eigen::Vector3d& query, std::span<Neighbour> out,
                      double reach = std::numeric_limits<double>::infinity()) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace frond
