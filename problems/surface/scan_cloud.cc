// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/scan_cloud.h"

#include <Eigen/Geometry>
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

ScanCloud::ScanCloud(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray)
    : order_(SpatialOrder(points)),
      points_(InOrder(points, order_)),
      stray_(points.size(), 0),
      tree_(points_) {
  for (std::size_t i = 0; i < order_.size() && !stray.empty(); ++i) stray_[i] = stray[order_[i]];
  outlier_ = stray_;
  CollectInliers();
  if (points_.empty()) return;
  Eigen::AlignedBox3d box;
  for (const auto& point : points_) box.extend(point);
  size_ = box.diagonal().norm();
  resolution_.spacing = PointSpacing(points_, tree_);
  resolution_.noise = LocalNoise(points_, outlier_, tree_);
}

// Where scan and fit are exact, the rest is rounding and has no outliers.
std::vector<std::uint8_t> ScanCloud::Outlying(const std::vector<Eigen::Vector3d>& offsets,
                                              double threshold) const {
  constexpr double kExact = 1e-6;  // of the cloud's size
  std::vector<std::uint8_t> found = OutlyingPoints(points_, offsets, tree_, threshold);
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = found[i] && offsets[i].norm() > kExact * size_;
  return found;
}

void ScanCloud::CollectInliers() {
  inliers_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!outlier_[i]) inliers_.push_back(points_[i]);
  }
}

bool ScanCloud::RemoveOutliers(const std::vector<Eigen::Vector3d>& inlier_offsets, double threshold) {
  std::vector<Eigen::Vector3d> offsets(points_.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0, k = 0; i < points_.size(); ++i) {
    if (!outlier_[i]) offsets[i] = inlier_offsets[k++];
  }
  const std::vector<std::uint8_t> found = Outlying(offsets, threshold);
  bool any = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (outlier_[i] || !found[i]) continue;
    outlier_[i] = 1;
    any = true;
  }
  if (any) CollectInliers();
  return any;
}

void ScanCloud::JudgeOutliers(const std::vector<Eigen::Vector3d>& offsets, double threshold) {
  outlier_ = Outlying(offsets, threshold);
  for (std::size_t i = 0; i < points_.size(); ++i) outlier_[i] = outlier_[i] || stray_[i];
  CollectInliers();
}

}  // namespace frond
