// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/centre_line.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/errors.h"

namespace frond {

CentreLine::CentreLine(std::vector<Eigen::Vector3d> nodes) : nodes_(std::move(nodes)), lengths_(1, 0.0) {
  for (std::size_t k = 1; k < nodes_.size(); ++k) {
    lengths_.push_back(lengths_.back() + (nodes_[k] - nodes_[k - 1]).norm());
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t next = std::min(k + 1, nodes_.size() - 1), last = k == 0 ? 0 : k - 1;
    tangents_.push_back((nodes_[next] - nodes_[last]).normalized());
  }
}

std::size_t CentreLine::SegmentOf(double s) const {
  const auto after = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s) - lengths_.begin();
  return static_cast<std::size_t>(after) - 1;
}

Eigen::Vector3d CentreLine::At(double s) const {
  const std::size_t k = SegmentOf(s);
  if (s < 0) return nodes_.front() + s * tangents_.front();
  if (s > length()) return nodes_.back() + (s - length()) * tangents_.back();
  const double share = (s - lengths_[k]) / (lengths_[k + 1] - lengths_[k]);
  return (1 - share) * nodes_[k] + share * nodes_[k + 1];
}

Eigen::Vector3d CentreLine::Tangent(double s) const {
  const std::size_t k = SegmentOf(s);
  const double share = std::clamp((s - lengths_[k]) / (lengths_[k + 1] - lengths_[k]), 0.0, 1.0);
  return ((1 - share) * tangents_[k] + share * tangents_[k + 1]).normalized();
}

double CentreLine::Locate(const Eigen::Vector3d& point) const {
  double best = std::numeric_limits<double>::infinity(), at = 0;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    const Eigen::Vector3d step = nodes_[k + 1] - nodes_[k];
    const double length = lengths_[k + 1] - lengths_[k];
    double along = (point - nodes_[k]).dot(step) / length;
    if (k > 0) along = std::max(along, 0.0);
    if (k + 2 < nodes_.size()) along = std::min(along, length);
    const double squared = (point - nodes_[k] - along / length * step).squaredNorm();
    if (squared < best) {
      best = squared;
      at = lengths_[k] + along;
    }
  }
  return at;
}

CentreLine StraightLine(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d unit = direction.normalized();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const auto& point : points) {
    begin = std::min(begin, (point - mean).dot(unit));
    end = std::max(end, (point - mean).dot(unit));
  }
  if (!(end > begin)) throw InputError("the cloud has no extent along the axis of its sections");
  return CentreLine({mean + begin * unit, mean + end * unit});
}

}  // namespace frond
