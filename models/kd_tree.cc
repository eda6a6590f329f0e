// SPDX-License-Identifier: BSD-3-Clause
#include "models/kd_tree.h"

#include <algorithm>
#include <array>
#include <nanoflann.hpp>

namespace frond {
namespace {

struct PointView {
  std::span<const Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointView, double>,
                                                 PointView, 3, std::uint32_t>;

}  // namespace

struct KdTree::Index {
  explicit Index(std::span<const Eigen::Vector3d> points)
      : view{points}, tree(3, view, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    tree.buildIndex();
  }
  PointView view;
  Tree tree;
};

KdTree::KdTree(std::span<const Eigen::Vector3d> points) : index_(std::make_unique<Index>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

std::size_t KdTree::size() const { return index_->view.points.size(); }

KdTree::Neighbour KdTree::Nearest(const Eigen::Vector3d& query) const {
  Neighbour nearest;
  Nearest(query, {&nearest, 1});
  return nearest;
}

std::size_t KdTree::Nearest(const Eigen::Vector3d& query, std::span<Neighbour> out, double reach) const {
  constexpr std::size_t kMost = 64;
  std::array<std::uint32_t, kMost> indices;
  std::array<double, kMost> squared;
  const std::size_t wanted = std::min(out.size(), kMost);
  nanoflann::KNNResultSet<double, std::uint32_t> result(wanted);
  result.init(indices.data(), squared.data());
  squared[wanted - 1] = std::min(squared[wanted - 1], reach * reach);  // the set's own bound until it is full
  index_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  for (std::size_t k = 0; k < result.size(); ++k) out[k] = {indices[k], squared[k]};
  return result.size();
}

}  // namespace frond
