// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/disparity_patch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace frond {
namespace {

using Row = Eigen::Matrix<double, 6, 1>;
constexpr int kQuadraticFrom = 12, kPlaneFrom = 6;

}  // namespace

AcceptedWindows::AcceptedWindows(const StereoMatches& matches, int width, int height)
    : matches_(matches),
      step_(std::max(1, matches.step)),
      numbers_(width / step_ + 1, height / step_ + 1, -1) {
  for (std::size_t i = 0; i < matches.windows.size(); ++i) {
    const MatchedWindow& window = matches.windows[i];
    if (window.status != WindowStatus::kAccepted) continue;
    numbers_(window.x / step_, window.y / step_) = static_cast<int>(i);
  }
}

DisparityPatch AcceptedWindows::PatchAt(const MatchedWindow& window, int reach) const {
  constexpr double kMostJump = 1;  // pixels off the window's own plane: beyond an edge
  const std::array<double, 6>& own = window.match.warp;
  const double scale = std::max(1, reach * step_);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Row right = Row::Zero();
  int count = 0;
  const int column = window.x / step_, row_number = window.y / step_;
  for (int k = row_number - reach; k <= row_number + reach; ++k) {
    for (int i = column - reach; i <= column + reach; ++i) {
      if (!numbers_.Contains(i, k) || numbers_(i, k) < 0) continue;
      const MatchedWindow& other = matches_.windows[static_cast<std::size_t>(numbers_(i, k))];
      const double xi = other.x - window.x, eta = other.y - window.y;
      if (std::abs(other.match.warp[0] - own[0] - own[1] * xi - own[2] * eta) > kMostJump) continue;
      const double a = xi / scale, b = eta / scale;
      Row row;
      row << 1, a, b, a * a / 2, a * b, b * b / 2;
      const double weight = 1 / std::max(other.match.sigma * other.match.sigma, 1e-12);
      normal += weight * row * row.transpose();
      right += weight * other.match.warp[0] * row;
      ++count;
    }
  }
  const DisparityPatch plane{.slope_x = own[1], .slope_y = own[2]};
  if (count < kPlaneFrom) return plane;
  if (count < kQuadraticFrom) {
    normal.bottomRows<3>().setZero();
    normal.rightCols<3>().setZero();
    normal.bottomRightCorner<3, 3>().setIdentity();
    right.tail<3>().setZero();
  }
  // Neighbours on one line leave the curvature across it open: none.
  normal.diagonal().tail<5>().array() += 1e-6 * normal(0, 0);
  const Row c = normal.ldlt().solve(right);
  if (!c.allFinite()) return plane;
  return {.slope_x = c[1] / scale,
          .slope_y = c[2] / scale,
          .xx = c[3] / (scale * scale),
          .xy = c[4] / (scale * scale),
          .yy = c[5] / (scale * scale)};
}

double PlaneOffset(const DisparityPatch& patch, const Mask& mask, int x, int y, int size) {
  const int half = size / 2;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int eta = -half; eta <= half; ++eta) {
    for (int xi = -half; xi <= half; ++xi) {
      if (!mask.empty() && (!mask.Contains(x + xi, y + eta) || mask(x + xi, y + eta) == 0)) continue;
      const Eigen::Vector3d row(1, xi, eta);
      normal += row * row.transpose();
      right += (0.5 * patch.xx * xi * xi + patch.xy * xi * eta + 0.5 * patch.yy * eta * eta) * row;
    }
  }
  const double offset = normal.ldlt().solve(right)[0];
  return std::isfinite(offset) ? offset : 0;
}

}  // namespace frond
