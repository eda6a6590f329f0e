// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_layout.h"

#include <algorithm>
#include <cmath>

namespace frond {
namespace {

constexpr int kProfileSteps = 40;

// The length of the mean profile (position, distance from the line) at positions from end to end.
struct Profile {
  std::vector<double> position, length;

  double PositionAt(double wanted) const {
    const auto after = std::upper_bound(length.begin() + 1, length.end() - 1, wanted) - length.begin();
    const auto k = static_cast<std::size_t>(after) - 1;
    const double share = (wanted - length[k]) / std::max(length[k + 1] - length[k], 1e-300);
    return position[k] + share * (position[k + 1] - position[k]);
  }
};

Profile MeanProfile(const CentreLine& line, std::span<const Eigen::Vector3d> points,
                    std::span<const double> positions, const CloudEnd& first, const CloudEnd& last,
                    bool along_surface) {
  const double begin = first.position, end = last.position;
  std::vector<double> position, radius;
  std::vector<double> sum(kProfileSteps, 0.0), count(kProfileSteps, 0.0), at(kProfileSteps, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = (positions[i] - begin) / (end - begin);
    if (!(share >= 0 && share <= 1)) continue;
    const auto k =
        static_cast<std::size_t>(std::min(static_cast<int>(share * kProfileSteps), kProfileSteps - 1));
    sum[k] += (points[i] - line.At(positions[i])).norm();
    at[k] += positions[i];
    count[k] += 1;
  }
  position.push_back(begin);
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] == 0 || !along_surface) continue;
    position.push_back(at[k] / count[k]);
    radius.push_back(sum[k] / count[k]);
  }
  position.push_back(end);
  radius.insert(radius.begin(), first.kind == SectionEnd::kPole || radius.empty() ? 0.0 : radius.front());
  radius.push_back(last.kind == SectionEnd::kPole ? 0.0 : radius.back());
  Profile profile{position, {0.0}};
  for (std::size_t k = 1; k < position.size(); ++k) {
    profile.length.push_back(profile.length.back() +
                             std::hypot(position[k] - position[k - 1], radius[k] - radius[k - 1]));
  }
  return profile;
}

}  // namespace

std::vector<SectionPlane> PlanesAlong(const CentreLine& line, std::span<const Eigen::Vector3d> points,
                                      std::span<const double> positions, const CloudEnd& first,
                                      const CloudEnd& last, int count, double spacing) {
  const bool pole = first.kind == SectionEnd::kPole || last.kind == SectionEnd::kPole;
  const Profile profile = MeanProfile(line, points, positions, first, last, pole);
  const double whole = profile.length.back();
  // Steps between an end and the plane next to it: none on a plane end, half on a rim, one before a pole.
  const auto steps = [](const CloudEnd& end) {
    return end.kind == SectionEnd::kPole ? 1.0 : end.kind == SectionEnd::kRim ? 0.5 : 0.0;
  };
  const double step = whole / std::max(count - 1 + steps(first) + steps(last), 1.0);
  const auto gap = [&](const CloudEnd& end) {
    const double even = steps(end) * step;
    if (end.kind == SectionEnd::kPole) return std::max({even, 2 * spacing, 0.3 * end.pole_radius});
    return even;
  };
  const double from = gap(first), to = whole - gap(last);
  std::vector<SectionPlane> planes;
  for (int k = 0; k < count; ++k) {
    const double s = profile.PositionAt(from + (to - from) * k / std::max(count - 1, 1));
    planes.push_back({.origin = line.At(s), .normal = line.Tangent(s)});
  }
  return planes;
}

}  // namespace frond
