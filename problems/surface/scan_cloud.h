// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "models/kd_tree.h"
#include "problems/surface/surface_quality.h"

namespace frond {

// A scan in its frame, put in spatial order, with what it can tell and which of its points are outliers.
class ScanCloud {
 public:
  // `stray`: 1 for points that are outliers from the start, by point, or empty.
  ScanCloud(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }    // all, in spatial order
  const std::vector<Eigen::Vector3d>& inliers() const { return inliers_; }  // in the same order
  const std::vector<std::uint8_t>& outlier() const { return outlier_; }     // by point in that order
  const KdTree& tree() const { return tree_; }                              // of points()
  const ScanResolution& resolution() const { return resolution_; }

  // Finds outliers among the inliers by their offsets from a surface (OutlyingPoints) and takes them out.
  // Says whether there were any.
  bool RemoveOutliers(const std::vector<Eigen::Vector3d>& inlier_offsets, double threshold);

  // The strays and what stands out by the offsets of all points, whatever was taken out before.
  void JudgeOutliers(const std::vector<Eigen::Vector3d>& offsets, double threshold);

  // Values by point in spatial order, in the order that the points were given in.
  template <typename T>
  std::vector<T> InGivenOrder(const std::vector<T>& values) const {
    std::vector<T> given(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) given[order_[i]] = values[i];
    return given;
  }

 private:
  std::vector<std::uint8_t> Outlying(const std::vector<Eigen::Vector3d>& offsets, double threshold) const;
  void CollectInliers();

  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3d> points_, inliers_;
  std::vector<std::uint8_t> stray_, outlier_;
  KdTree tree_;
  ScanResolution resolution_;
  double size_ = 0;  // the diagonal of the points' bounding box
};

}  // namespace frond
