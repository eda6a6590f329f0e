// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_cloud.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "problems/turntable/disparity_patch.h"

namespace frond {
namespace {

bool IsPlane(const WindowModel& window) {
  return window.warp == WarpKind::kShift || window.warp == WarpKind::kLinear;
}

std::array<std::uint8_t, 3> ColourAt(const NormalPair& pair, int x, int y) {
  if (!pair.left_colour.empty()) return pair.left_colour(x, y);
  const auto grey = static_cast<std::uint8_t>(std::lround(std::clamp(pair.left(x, y), 0.0F, 255.0F)));
  return {grey, grey, grey};
}

}  // namespace

std::vector<ScanPoint> TriangulateView(const StereoMatches& matches, const NormalPair& pair,
                                       const TurntableRig& rig, const WindowModel& window_model,
                                       double left_angle, int view, const ViewCloudOptions& options) {
  const Rectification& normal = pair.normal;
  const AcceptedWindows grid(matches, normal.width, normal.height);
  const Eigen::Isometry3d disk_from_camera = rig.CameraFromDisk(left_angle).inverse();
  const Eigen::Matrix3d disk_from_normal = disk_from_camera.linear() * normal.rotation[0].transpose();
  const Eigen::Vector3d centre = disk_from_camera.translation();
  std::vector<ScanPoint> points;
  for (const MatchedWindow& window : matches.windows) {
    if (window.status != WindowStatus::kAccepted) continue;
    const DisparityPatch patch = grid.PatchAt(window, options.normal_reach);
    double disparity = window.match.warp[0];
    if (options.unbend && IsPlane(window_model)) {
      disparity -= PlaneOffset(patch, pair.left_mask, window.x, window.y, window_model.size);
    }
    const double depth_disparity = disparity - normal.cx[0] + normal.cx[1];
    if (!(depth_disparity > 0) || !(window.match.sigma > 0)) continue;
    ScanPoint point;
    point.view = view;
    point.position = disk_from_camera * normal.Triangulate(window.x, window.y, disparity);
    point.to_camera = (centre - point.position).normalized();
    point.sigma = window.match.sigma * std::abs(normal.RangeSlope(window.x, window.y, disparity));
    const Eigen::Vector3d away(
        normal.f * patch.slope_x, normal.f * patch.slope_y,
        depth_disparity - patch.slope_x * (window.x - normal.cx[0]) - patch.slope_y * (window.y - normal.cy));
    point.normal = -(disk_from_normal * away).normalized();
    point.cosine = point.normal.dot(point.to_camera);
    if (point.cosine < options.least_cosine || point.position.z() < options.height_above_disk) continue;
    point.colour = ColourAt(pair, window.x, window.y);
    points.push_back(point);
  }
  return points;
}

}  // namespace frond
