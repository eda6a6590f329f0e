// SPDX-License-Identifier: BSD-3-Clause
// Surfaces closed in u about the z axis, with and without poles, for the tests.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "models/knot_vector.h"
#include "models/nurbs_surface.h"

namespace frond {

// A profile of points (radius, z) turned about the z axis, round to 1e-5 with 16 control points around and to
// 1e-7 with 48; its normals point outwards where the profile rises.
inline NurbsSurface Turned(const BSplineBasis& v, const std::vector<Eigen::Vector2d>& profile,
                           const std::vector<double>& profile_weights, int around = 48) {
  constexpr int kDegree = 3;
  const double step = 2 * std::numbers::pi / around;
  // The mean of a cubic's radii at its knots and half-way, where its control points lie on the unit circle.
  const double knot = (2 + std::cos(step)) / 3,
               half = (23 * std::cos(step / 2) + std::cos(3 * step / 2)) / 24;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < around + kDegree; ++i) {
    const double angle = step * (i % around);
    for (std::size_t j = 0; j < profile.size(); ++j) {
      const double radius = 2 * profile[j].x() / (knot + half);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), profile[j].y());
      weights.push_back(profile_weights[j]);
    }
  }
  return {PeriodicUniformBasis(kDegree, around), v, points, weights};
}

// Exact along v, from the south pole to the north pole.
inline NurbsSurface TurnedSphere(double r, int around = 48) {
  const double w = std::sqrt(0.5);
  return Turned(BSplineBasis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), {{0, -r}, {r, -r}, {r, 0}, {r, r}, {0, r}},
                {1, w, 1, w, 1}, around);
}

// The southern half of it.
inline NurbsSurface TurnedCup(double r, int around = 48) {
  return Turned(BSplineBasis(2, {0, 0, 0, 1, 1, 1}), {{0, -r}, {r, -r}, {r, 0}}, {1, std::sqrt(0.5), 1},
                around);
}

inline NurbsSurface TurnedTube(double radius, double height, int around = 48) {
  return Turned(UniformBasis(1, 2), {{radius, 0}, {radius, height}}, {1, 1}, around);
}

// A bumpy egg about 40 long along z, 11 × 10 control points of degree (3, 3), C¹ at the poles, which are not
// on the axis nor square to it. An end without a pole is open.
inline NurbsSurface Egg(PoleEnds poles, double bumps = 0.5) {
  constexpr int kAround = 11, kAlong = 10, kDegree = 3;
  Random random(17);
  const auto bump = [&]() -> Eigen::Vector3d {
    return bumps * Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
  };
  std::vector<Eigen::Vector3d> net(kAround * kAlong);
  const auto at = [&](int i, int j) -> Eigen::Vector3d& {
    return net[static_cast<std::size_t>(i * kAlong + j)];
  };
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAround;
    for (int j = 0; j < kAlong; ++j) {
      const double t = std::numbers::pi * (j + 1.5) / (kAlong + 2);
      at(i, j) = Eigen::Vector3d(14 * std::sin(t) * std::cos(angle), 11 * std::sin(t) * std::sin(angle),
                                 -20 * std::cos(t)) +
                 bump();
    }
  }
  for (const auto& [pole, row, next] :
       {std::tuple(poles.begin, 0, 1), std::tuple(poles.end, kAlong - 1, kAlong - 2)}) {
    if (!pole) continue;
    const Eigen::Vector3d centre = Eigen::Vector3d(0.5, -0.3, row == 0 ? -20 : 20) + bump();
    const Eigen::Vector3d a = Eigen::Vector3d(4.5, 0.5, 0) + bump(), b = Eigen::Vector3d(-0.4, 4, 0) + bump();
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      at(i, row) = centre;
      at(i, next) = centre + std::cos(angle) * a + std::sin(angle) * b;
    }
  }
  std::vector<Eigen::Vector3d> points = net;
  points.insert(points.end(), net.begin(), net.begin() + kDegree * kAlong);
  return {PeriodicUniformBasis(kDegree, kAround), UniformBasis(kDegree, kAlong), points};
}

}  // namespace frond
