// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/turntable/pear_scan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

// Derivatives by central differences.
std::array<Eigen::Vector3d, 2> Tangents(const LobedPear& pear, double u, double t) {
  constexpr double kStep = 1e-6;
  return {(pear.At(u + kStep, t) - pear.At(u - kStep, t)) / (2 * kStep),
          (pear.At(u, t + kStep) - pear.At(u, t - kStep)) / (2 * kStep)};
}

}  // namespace

Eigen::Vector3d LobedPear::At(double u, double t) const {
  const double s = std::sin(t);
  const double radius = 30 * s * (1 - 0.35 * std::cos(t)) * (1 + lobes * s * s * std::cos(3 * u));
  return {radius * std::cos(u), radius * std::sin(u), 50 * (1 + std::cos(t))};
}

Eigen::Vector3d LobedPear::Normal(double u, double t) const {
  const auto [du, dt] = Tangents(*this, u, std::clamp(t, 1e-4, kPi - 1e-4));
  return dt.cross(du).normalized();
}

double LobedPear::SignedDistance(const Eigen::Vector3d& point) const {
  double u = std::atan2(point.y(), point.x());
  double t = std::atan2(std::hypot(point.x(), point.y()) * 50 / 30, point.z() - 50);
  for (int k = 0; k < 30; ++k) {  // Gauss-Newton
    const auto [du, dt] = Tangents(*this, u, t);
    const Eigen::Vector3d r = point - At(u, t);
    u += std::clamp(r.dot(du) / std::max(du.squaredNorm(), 1e-3), -0.2, 0.2);
    t = std::clamp(t + std::clamp(r.dot(dt) / dt.squaredNorm(), -0.2, 0.2), 1e-6, kPi - 1e-6);
  }
  const Eigen::Vector3d r = point - At(u, t);
  return r.dot(Normal(u, t)) < 0 ? -r.norm() : r.norm();
}

std::vector<Eigen::Vector3d> PearPoints(const LobedPear& pear, int count, double first_t, double last_t,
                                        double noise, Random* random) {
  constexpr double kMostArea = 30 * 1.35 * 62;  // |S_u × S_t| is nowhere larger
  std::vector<Eigen::Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    const double u = random->Uniform(0, 2 * kPi), t = random->Uniform(first_t, last_t);
    const auto [du, dt] = Tangents(pear, u, t);
    if (random->Uniform(0, kMostArea) > du.cross(dt).norm()) continue;
    points.push_back(pear.At(u, t) + noise * random->Normal() * pear.Normal(u, t));
  }
  return points;
}

std::vector<ScanPoint> PearView(const LobedPear& pear, double angle, double spacing, double sigma, int view,
                                Random* random) {
  // The disk at `angle` is seen as by a camera that went round the other way.
  const Eigen::AngleAxisd turn(-angle, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d camera = turn * Eigen::Vector3d(600, 0, 50);
  std::vector<ScanPoint> points;
  // Points on a grid of heights and angles, kept with the share that their image has of their area.
  const auto rows = static_cast<int>(160 / spacing), columns = static_cast<int>(220 / spacing);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const double u = 2 * kPi * (k + random->Uniform()) / columns, t = kPi * (i + random->Uniform()) / rows;
      const Eigen::Vector3d p = pear.At(u, t), normal = pear.Normal(u, t);
      const Eigen::Vector3d ray = (camera - p).normalized();
      const auto [du, dt] = Tangents(pear, u, t);
      const double cosine = normal.dot(ray);
      const double share =
          cosine * du.cross(dt).norm() * (2 * kPi / columns) * (kPi / rows) / (spacing * spacing);
      if (cosine < 0.15 || random->Uniform() > share) continue;
      const double deviation = sigma / std::sqrt(cosine);
      points.push_back(
          {.position = p + deviation * random->Normal() * ray,
           .normal = (normal + 0.05 * Eigen::Vector3d(random->Normal(), random->Normal(), random->Normal()))
                         .normalized(),
           .to_camera = ray,
           .sigma = deviation,
           .colour = {200, 100, static_cast<std::uint8_t>(view % 256)},
           .view = view,
           .cosine = cosine});
    }
  }
  return points;
}

}  // namespace frond
