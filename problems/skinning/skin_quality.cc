// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

constexpr int kSamples = 96;

// The barycentre of a curve's points by arc length.
template <typename PointAt>
Eigen::Vector3d Barycentre(const PointAt& point_at) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), last = point_at(0);
  double length = 0;
  for (int k = 1; k <= kSamples; ++k) {
    const Eigen::Vector3d next = point_at(k);
    const double step = (next - last).norm();
    sum += step / 2 * (next + last);
    length += step;
    last = next;
  }
  return length > 0 ? Eigen::Vector3d(sum / length) : last;
}

}  // namespace

double TwistDegrees(const NurbsCurve& a, const SectionPlane& plane_a, const NurbsCurve& b,
                    const SectionPlane& plane_b) {
  const auto angles = [](const NurbsCurve& curve, SectionPlane plane) {
    const auto at = [&](int k) {
      const double share = static_cast<double>(k) / kSamples;
      return curve.Evaluate(curve.basis().begin() + share * (curve.basis().end() - curve.basis().begin()));
    };
    plane.origin = Barycentre(at);
    std::array<double, kSamples> result;
    for (int k = 0; k < kSamples; ++k) result[static_cast<std::size_t>(k)] = plane.Angle(at(k));
    return result;
  };
  const auto of_a = angles(a, plane_a), of_b = angles(b, plane_b);
  double sine = 0, cosine = 0;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    sine += std::sin(of_b[k] - of_a[k]);
    cosine += std::cos(of_b[k] - of_a[k]);
  }
  return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

}  // namespace frond
