// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/surface/closed_clouds.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/random.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

// Position and outward normal at (turns, share along); points are drawn where the area is, by rejection.
using Shape = std::function<Eigen::Vector3d(double, double)>;

ClosedCloud Scan(const Shape& shape, const Shape& area_normal, int count, double noise, std::uint64_t seed,
                 const std::vector<double>& rims) {
  Random random(seed);
  double most = 0;
  for (int k = 0; k < 2000; ++k) {
    most = std::max(most, area_normal((k % 50) / 50.0, (k / 50 + 0.5) / 40.0).norm());
  }
  ClosedCloud cloud;
  while (static_cast<int>(cloud.points.size()) < count) {
    const double u = random.Uniform(), v = random.Uniform();
    const Eigen::Vector3d normal = area_normal(u, v);
    if (random.Uniform(0, 1.1 * most) > normal.norm()) continue;
    cloud.clean.push_back(shape(u, v));
    cloud.normals.push_back(normal.normalized());
    cloud.place.emplace_back(u, v);
    cloud.points.push_back(cloud.clean.back() + noise * random.Normal() * cloud.normals.back());
  }
  for (const double v : rims) {
    cloud.rims.emplace_back();
    for (int k = 0; k < 120; ++k) cloud.rims.back().push_back(shape(k / 120.0, v));
  }
  return cloud;
}

// By central differences, S_u × S_v.
Shape NormalOf(const Shape& shape) {
  return [shape](double u, double v) -> Eigen::Vector3d {
    constexpr double kStep = 1e-5;
    const Eigen::Vector3d du = shape(u + kStep, v) - shape(u - kStep, v),
                          dv = shape(u, v + kStep) - shape(u, v - kStep);
    return du.cross(dv) / (4 * kStep * kStep);
  };
}

}  // namespace

ClosedCloud EllipsoidCloud(const Eigen::Vector3d& radii, int count, double noise, double open,
                           std::uint64_t seed) {
  const double end = open < 1 ? std::acos(1 - 2 * open) : kPi;
  const Shape shape = [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * kPi * u, t = end * v;
    return {-radii.x() * std::cos(t), radii.y() * std::sin(t) * std::cos(angle),
            radii.z() * std::sin(t) * std::sin(angle)};
  };
  return Scan(shape, NormalOf(shape), count, noise, seed,
              open < 1 ? std::vector<double>{1} : std::vector<double>{});
}

ClosedCloud AppleCloud(double radius, int count, double noise, std::uint64_t seed) {
  const Shape shape = [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * kPi * u, t = kPi * v, s = std::sin(t);
    const double r =
        radius * (1 - 0.35 * std::exp(-s * s / 0.12)) * (1 + 0.02 * std::cos(5 * angle) * s * s * s);
    return {-0.9 * r * std::cos(t), r * s * std::cos(angle), r * s * std::sin(angle)};
  };
  return Scan(shape, NormalOf(shape), count, noise, seed, {});
}

ClosedCloud TubeCloud(double radius, double length, double bend, int count, double noise,
                      std::uint64_t seed) {
  const Shape shape = [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * kPi * u, r = radius * (1 + 0.2 * std::sin(kPi * v));
    if (bend == 0) return {length * v, r * std::cos(angle), r * std::sin(angle)};
    const double arc = length / bend, t = bend * (v - 0.5), reach = arc - r * std::cos(angle);
    return {reach * std::sin(t), arc - reach * std::cos(t), r * std::sin(angle)};
  };
  return Scan(shape, NormalOf(shape), count, noise, seed, {0, 1});
}

}  // namespace frond
