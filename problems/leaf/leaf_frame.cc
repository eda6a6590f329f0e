// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_frame.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.h"
#include "problems/surface/outliers.h"
#include "problems/surface/principal_axes.h"

namespace frond {
namespace {

// How the sheet's points spread along x, as if each stood for the same area.
class WidthProfile {
 public:
  explicit WidthProfile(std::span<const Eigen::Vector3d> points) {
    const auto by_x = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); };
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), by_x);
    begin_ = low->x();
    length_ = high->x() - begin_;
    share_.reserve(points.size());
    for (const Eigen::Vector3d& p : points) share_.push_back((p.x() - begin_) / length_);
    std::sort(share_.begin(), share_.end());
  }

  // Mean width over [from, to] (shares of the length), as a share of the mean width of the whole.
  double MeanWidth(double from, double to) const {
    const auto low = std::lower_bound(share_.begin(), share_.end(), from);
    const auto high = std::upper_bound(share_.begin(), share_.end(), to);
    return static_cast<double>(high - low) / static_cast<double>(share_.size()) / (to - from);
  }

  std::size_t size() const { return share_.size(); }

 private:
  double begin_, length_;
  std::vector<double> share_;
};

// True where an end stops wide: a tip cut off, where a base has its petiole's width at its very edge and a
// tip next to none. The edge's width is that of a line through the widths at 1 and 3 % of the length (nearer,
// noise and a slanting edge thin it). A petiole is no cut: the strip does not widen inwards.
bool IsCut(const WidthProfile& profile, bool at_begin) {
  const auto width = [&](double from, double to) {
    return at_begin ? profile.MeanWidth(from, to) : profile.MeanWidth(1 - to, 1 - from);
  };
  const double at_1 = width(0.005, 0.015), at_3 = width(0.025, 0.035);
  const double edge = at_1 - 0.5 * (at_3 - at_1);
  return edge > 0.25 && width(0.06, 0.09) > 1.35 * edge;
}

// True where the end at the least x is the tip. Widths are shares of the mean width (the largest is about
// 1.6).
bool TipIsAtLeastX(const WidthProfile& profile) {
  constexpr std::size_t kEnough = 20000;  // points for the very edges to be judged by
  if (profile.size() >= kEnough) {
    constexpr double kBlunt = 0.115;  // a base rather than a tip, where the other end is cut
    const bool low_cut = IsCut(profile, true), high_cut = IsCut(profile, false);
    if (low_cut && !high_cut) return profile.MeanWidth(0.98, 1) > kBlunt;
    if (high_cut && !low_cut) return profile.MeanWidth(0, 0.02) < kBlunt;
  }
  // Enough points at each end to compare: 80 if the leaf were a rectangle, some 10 at a tip.
  const double end = std::clamp(80.0 / static_cast<double>(profile.size()), 0.02, 0.25);
  return profile.MeanWidth(0, end) < profile.MeanWidth(1 - end, 1);
}

// Least squares z = c₀ + c₁x + c₂y + c₃x² + c₄xy + c₅y²: the heights of the blade's bulges along (c₃) and
// across (c₅) at the ends of a leaf of unit half-extents.
Eigen::Vector2d Bulges(std::span<const Eigen::Vector3d> points, double half_length, double half_width) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Eigen::Vector3d& p : points) {
    const double x = p.x() / half_length, y = p.y() / half_width;
    Eigen::Matrix<double, 6, 1> row;
    row << 1, x, y, x * x, x * y, y * y;
    normal += row * row.transpose();
    right += row * p.z();
  }
  const Eigen::Matrix<double, 6, 1> c = normal.ldlt().solve(right);
  return {c[3], c[5]};
}

void FixSigns(std::span<const Eigen::Vector3d> local, double half_length, double half_width,
              Eigen::Matrix3d* axes) {
  if (TipIsAtLeastX(WidthProfile(local))) axes->col(0) *= -1;
  const Eigen::Vector2d bulge = Bulges(local, half_length, half_width);
  constexpr double kHardlyBent = 0.004;  // of the width
  const double deciding = std::abs(bulge.y()) >= kHardlyBent * half_width ? bulge.y() : bulge.x();
  if (deciding > 0) axes->col(2) *= -1;  // the margins (the ends) were above the middle
  axes->col(1) = axes->col(2).cross(axes->col(0));
}

}  // namespace

std::vector<Eigen::Vector3d> PointsInFrame(std::span<const Eigen::Vector3d> points, const LeafFrame& frame) {
  std::vector<Eigen::Vector3d> local;
  local.reserve(points.size());
  std::size_t next_stray = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (next_stray < frame.strays.size() && frame.strays[next_stray] == i) {
      ++next_stray;
      continue;
    }
    local.push_back(frame.FromInput(points[i]));
  }
  return local;
}

LeafFrame FindLeafFrame(std::span<const Eigen::Vector3d> points, const LeafFrameOptions& options) {
  std::vector<std::uint8_t> stray(points.size(), 0);
  if (options.leave_out_strays && points.size() >= 10) {
    const PrincipalAxes all = FindPrincipalAxes(points, stray);
    std::vector<Eigen::Vector3d> local;
    local.reserve(points.size());
    for (const Eigen::Vector3d& point : points) local.push_back(all.axes.transpose() * (point - all.origin));
    stray = StrayPoints(local);
  }
  LeafFrame frame;
  for (std::size_t i = 0; i < stray.size(); ++i) {
    if (stray[i]) frame.strays.push_back(i);
  }
  const std::size_t kept = points.size() - frame.strays.size();
  if (kept < 10) {
    throw InputError("the cloud has " + std::to_string(kept) + " usable points, a leaf needs at least 10");
  }
  const PrincipalAxes axes = FindPrincipalAxes(points, stray);
  if (!(axes.deviations.y() > 1e-9 * axes.deviations.x())) {
    throw InputError("the cloud's points lie on one line (or in one place): no leaf surface can be fitted");
  }
  frame.origin = axes.origin;
  frame.axes = axes.axes;
  const std::vector<Eigen::Vector3d> local = PointsInFrame(points, frame);
  Eigen::Vector3d low = local.front(), high = local.front();
  for (const Eigen::Vector3d& p : local) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  frame.length = high.x() - low.x();
  frame.width = high.y() - low.y();
  FixSigns(local, 0.5 * frame.length, 0.5 * frame.width, &frame.axes);
  return frame;
}

}  // namespace frond
