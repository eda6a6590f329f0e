// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/sheet_cloud.h"

#include <algorithm>

#include "problems/surface/local_noise.h"
#include "problems/surface/outliers.h"
#include "problems/surface/spatial_order.h"

namespace frond {
namespace {

std::vector<Eigen::Vector3d> InOrder(std::span<const Eigen::Vector3d> points,
                                     const std::vector<std::uint32_t>& order) {
  std::vector<Eigen::Vector3d> ordered;
  ordered.reserve(points.size());
  for (const std::uint32_t i : order) ordered.push_back(points[i]);
  return ordered;
}

}  // namespace

SheetCloud::SheetCloud(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray)
    : order_(SpatialOrder(points)),
      points_(InOrder(points, order_)),
      stray_(points.size(), 0),
      tree_(points_) {
  for (std::size_t i = 0; i < order_.size() && !stray.empty(); ++i) stray_[i] = stray[order_[i]];
  outlier_ = stray_;
  CollectInliers();
  if (points_.empty()) return;
  resolution_.spacing = PointSpacing(points_, tree_);
  resolution_.noise = LocalNoise(points_, outlier_, tree_);
}

void SheetCloud::CollectInliers() {
  inliers_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!outlier_[i]) inliers_.push_back(points_[i]);
  }
}

bool SheetCloud::RemoveOutliers(const std::vector<Eigen::Vector3d>& inlier_offsets, double threshold) {
  std::vector<Eigen::Vector3d> offsets(points_.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0, k = 0; i < points_.size(); ++i) {
    if (!outlier_[i]) offsets[i] = inlier_offsets[k++];
  }
  const std::vector<std::uint8_t> found = OutlyingPoints(points_, offsets, tree_, threshold);
  bool any = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (outlier_[i] || !found[i]) continue;
    outlier_[i] = 1;
    any = true;
  }
  if (any) CollectInliers();
  return any;
}

void SheetCloud::JudgeOutliers(const std::vector<Eigen::Vector3d>& offsets, double threshold) {
  outlier_ = OutlyingPoints(points_, offsets, tree_, threshold);
  for (std::size_t i = 0; i < points_.size(); ++i) outlier_[i] = outlier_[i] || stray_[i];
  CollectInliers();
}

}  // namespace frond
