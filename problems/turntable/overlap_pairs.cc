// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/overlap_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/median.h"
#include "base/parallel.h"
#include "models/kd_tree.h"

namespace frond {
namespace {

constexpr double kNormalAgreement = 0.8;
constexpr std::size_t kLeastRows = 30;  // fewer do not hold a view

// A view's points after its motion, and a tree of them.
struct MovedView {
  std::vector<Eigen::Vector3d> positions = {};
  std::vector<Eigen::Vector3d> normals = {};
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();
  double spacing = 0;
  std::unique_ptr<KdTree> tree = nullptr;
};

void Move(const std::vector<ScanPoint>& view, const Eigen::Isometry3d& motion, MovedView* moved) {
  for (const ScanPoint& p : view) {
    moved->positions.push_back(motion * p.position);
    moved->normals.push_back(motion.linear() * p.normal);
    moved->facing += moved->normals.back();
  }
  moved->facing.normalize();
  moved->tree = std::make_unique<KdTree>(moved->positions);
  std::vector<double> nearest;
  std::array<KdTree::Neighbour, 2> found;
  for (std::size_t i = 0; i < view.size(); i += 1 + view.size() / 500) {
    moved->tree->Nearest(moved->positions[i], found);
    nearest.push_back(std::sqrt(found[1].squared_distance));
  }
  moved->spacing = Median(std::move(nearest));
}

std::vector<PlaneRow> RowsOf(const std::vector<ScanPoint>& first, const MovedView& moved_first,
                             const std::vector<ScanPoint>& second, const MovedView& moved_second,
                             const PoseRefinementOptions& options) {
  const double reach = options.reach * moved_second.spacing;
  std::vector<PlaneRow> rows;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i].cosine < options.least_cosine) continue;
    const KdTree::Neighbour nearest = moved_second.tree->Nearest(moved_first.positions[i]);
    if (nearest.squared_distance > reach * reach) continue;
    const std::size_t k = nearest.index;
    if (second[k].cosine < options.least_cosine) continue;
    if (moved_first.normals[i].dot(moved_second.normals[k]) < kNormalAgreement) continue;
    // At the end of what the other view saw the nearest point is no foot.
    const Eigen::Vector3d gap = moved_first.positions[i] - moved_second.positions[k];
    const double aside = (gap - gap.dot(moved_second.normals[k]) * moved_second.normals[k]).norm();
    if (aside > moved_second.spacing) continue;
    rows.push_back({moved_first.positions[i], moved_second.positions[k], moved_second.normals[k],
                    std::hypot(first[i].NormalSigma(), second[k].NormalSigma())});
  }
  // Evenly thinned out to the number asked for.
  if (rows.size() > options.points_per_overlap) {
    std::vector<PlaneRow> some;
    for (std::size_t k = 0; k < options.points_per_overlap; ++k) {
      some.push_back(rows[k * rows.size() / options.points_per_overlap]);
    }
    rows = std::move(some);
  }
  return rows;
}

}  // namespace

std::vector<OverlapPair> FindOverlaps(const std::vector<std::vector<ScanPoint>>& views,
                                      const std::vector<Eigen::Isometry3d>& motion,
                                      const PoseRefinementOptions& options, int threads) {
  std::vector<MovedView> moved(views.size());
  ParallelFor(views.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (views[v].size() >= kLeastRows) Move(views[v], motion[v], &moved[v]);
    }
  });
  std::vector<OverlapPair> overlaps;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = 0; b < views.size(); ++b) {
      // Views that face apart by more than a right angle have next to nothing in common.
      if (a == b || !moved[a].tree || !moved[b].tree || moved[a].facing.dot(moved[b].facing) < 0) continue;
      overlaps.push_back({a, b, {}});
    }
  }
  ParallelFor(overlaps.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      OverlapPair& overlap = overlaps[k];
      overlap.rows = RowsOf(views[overlap.first], moved[overlap.first], views[overlap.second],
                            moved[overlap.second], options);
    }
  });
  std::erase_if(overlaps, [](const OverlapPair& overlap) { return overlap.rows.size() < kLeastRows; });
  return overlaps;
}

OverlapErrors ErrorsOfOverlaps(const std::vector<OverlapPair>& overlaps) {
  OverlapErrors errors;
  errors.overlaps = overlaps.size();
  std::vector<double> off, relative;
  for (const OverlapPair& overlap : overlaps) {
    for (const PlaneRow& row : overlap.rows) {
      off.push_back(std::abs(row.normal.dot(row.point - row.foot)));
      relative.push_back(off.back() / row.sigma);
    }
  }
  errors.correspondences = off.size();
  errors.rms = 1.4826 * Median(std::move(off));
  errors.normalised = 1.4826 * Median(std::move(relative));
  return errors;
}

}  // namespace frond
