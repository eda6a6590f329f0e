// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_cloud.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace frond {
namespace {

constexpr std::size_t kLeastNeighbours = 6;

// The accepted windows by their place in the grid; −1 where there is none.
class WindowGrid {
 public:
  explicit WindowGrid(const StereoMatches& matches, int width, int height)
      : matches_(matches),
        step_(std::max(1, matches.step)),
        numbers_(width / step_ + 1, height / step_ + 1, -1) {
    for (std::size_t i = 0; i < matches.windows.size(); ++i) {
      const MatchedWindow& window = matches.windows[i];
      if (window.status != WindowStatus::kAccepted) continue;
      numbers_(window.x / step_, window.y / step_) = static_cast<int>(i);
    }
  }

  // (δ₁, δ₂) of the plane through the accepted windows within `reach` steps that lie on the same surface,
  // weighted by 1/σ²; the window's own where these are fewer than six.
  Eigen::Vector2d Slopes(const MatchedWindow& window, int reach) const {
    // Neighbours whose own planes disagree by more lie beyond an edge.
    constexpr double kMostJump = 1.0;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    const int column = window.x / step_, row = window.y / step_;
    for (int k = row - reach; k <= row + reach; ++k) {
      for (int i = column - reach; i <= column + reach; ++i) {
        if (!numbers_.Contains(i, k) || numbers_(i, k) < 0) continue;
        const MatchedWindow& other = matches_.windows[static_cast<std::size_t>(numbers_(i, k))];
        const double xi = other.x - window.x, eta = other.y - window.y;
        const double jump = other.match.warp[0] - window.match.warp[0] - window.match.warp[1] * xi -
                            window.match.warp[2] * eta;
        if (std::abs(jump) > kMostJump) continue;
        const Eigen::Vector3d line(1, xi, eta);
        const double weight = 1 / std::max(other.match.sigma * other.match.sigma, 1e-12);
        normal += weight * line * line.transpose();
        right += weight * other.match.warp[0] * line;
        ++count;
      }
    }
    const Eigen::Vector2d own(window.match.warp[1], window.match.warp[2]);
    if (count < kLeastNeighbours) return own;
    const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
    const Eigen::Vector3d plane = factor.solve(right);
    return factor.isPositive() && plane.allFinite() ? Eigen::Vector2d(plane.tail<2>()) : own;
  }

 private:
  const StereoMatches& matches_;
  int step_;
  Raster<int> numbers_;
};

}  // namespace

std::vector<ScanPoint> TriangulateView(const StereoMatches& matches, const NormalPair& pair,
                                       const TurntableRig& rig, double left_angle, int view,
                                       const ViewCloudOptions& options) {
  const Rectification& normal = pair.normal;
  const WindowGrid grid(matches, normal.width, normal.height);
  const Eigen::Isometry3d disk_from_camera = rig.CameraFromDisk(left_angle).inverse();
  const Eigen::Matrix3d disk_from_normal = disk_from_camera.linear() * normal.rotation[0].transpose();
  const Eigen::Vector3d centre = disk_from_camera.translation();
  std::vector<ScanPoint> points;
  for (const MatchedWindow& window : matches.windows) {
    if (window.status != WindowStatus::kAccepted) continue;
    const double disparity = window.match.warp[0];
    const double depth_disparity = disparity - normal.cx[0] + normal.cx[1];
    if (!(depth_disparity > 0) || !(window.match.sigma > 0)) continue;
    ScanPoint point;
    point.view = view;
    point.position = disk_from_camera * normal.Triangulate(window.x, window.y, disparity);
    point.to_camera = (centre - point.position).normalized();
    point.sigma = window.match.sigma * std::abs(normal.RangeSlope(window.x, window.y, disparity));
    const Eigen::Vector2d slope = grid.Slopes(window, options.normal_reach);
    const Eigen::Vector3d away(
        normal.f * slope[0], normal.f * slope[1],
        depth_disparity - slope[0] * (window.x - normal.cx[0]) - slope[1] * (window.y - normal.cy));
    point.normal = -(disk_from_normal * away).normalized();
    point.cosine = point.normal.dot(point.to_camera);
    if (point.cosine < options.least_cosine || point.position.z() < options.height_above_disk) continue;
    if (!pair.left_colour.empty()) {
      point.colour = pair.left_colour(window.x, window.y);
    } else {
      const float grey = std::clamp(pair.left(window.x, window.y), 0.0F, 255.0F);
      point.colour.fill(static_cast<std::uint8_t>(std::lround(grey)));
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace frond
