// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/end_quadric.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace frond {
namespace {

using Row = Eigen::Matrix<double, 9, 1>;

}  // namespace

std::optional<double> EndQuadric::At(double y, double z, double end) const {
  const Eigen::Vector3d across(0, y, z);
  const double square = a(0, 0), linear = 2 * (a.row(0).dot(across) + b.x());
  const double rest = across.dot(a * across) + 2 * b.dot(across) + c;
  const double root = linear * linear - 4 * square * rest;
  if (!(root > 0)) return std::nullopt;
  // There ∂F/∂x = 2 square x + linear is this, and x = (slope − linear) / (2 square).
  const double slope = end * std::sqrt(root);
  if (std::abs(linear + slope) < 1e-12 * std::abs(slope)) return std::nullopt;
  return -2 * rest / (linear + slope);
}

std::optional<EndQuadric> QuadricThrough(std::span<const Eigen::Vector3d> points) {
  constexpr std::size_t kLeast = 40;
  if (points.size() < kLeast) return std::nullopt;
  double scale = 0;  // the unit in which the unknowns are of one size
  for (const Eigen::Vector3d& p : points) scale = std::max(scale, p.norm());
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Row right = Row::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point / scale;
    Row row;
    row << p.y() * p.y() - p.z() * p.z(), p.y() * p.z(), p.y(), p.z(), p.x(), p.x() * p.x(), p.x() * p.y(),
        p.x() * p.z(), 1;
    normal += row * row.transpose();
    right -= (p.y() * p.y() + p.z() * p.z()) * row;
  }
  const Row k = normal.ldlt().solve(right);
  if (!k.allFinite()) return std::nullopt;
  EndQuadric quadric;
  quadric.a << k[5], k[6] / 2, k[7] / 2, k[6] / 2, 1 + k[0], k[1] / 2, k[7] / 2, k[1] / 2, 1 - k[0];
  quadric.b = scale * Eigen::Vector3d(k[4], k[2], k[3]) / 2;
  quadric.c = scale * scale * k[8];
  return quadric;
}

std::optional<EndQuadric> QuadricTouching(std::span<const TangentPlane> planes) {
  constexpr std::size_t kLeast = 100;
  constexpr double kMostMiss = 1.0 / 200;
  if (planes.size() < kLeast) return std::nullopt;
  double scale = 0;
  for (const TangentPlane& plane : planes) scale = std::max(scale, std::abs(plane.offset));
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Row right = Row::Zero();
  for (const TangentPlane& plane : planes) {
    const Eigen::Vector3d& n = plane.normal;
    const double h = plane.offset / scale;
    Row row;
    row << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), 2 * n.x() * n.y(), 2 * n.x() * n.z(),
        2 * n.y() * n.z(), -2 * h * n.x(), -2 * h * n.y(), -2 * h * n.z();
    normal += row * row.transpose();
    right -= h * h * row;
  }
  const Row k = normal.ldlt().solve(right);
  if (!k.allFinite()) return std::nullopt;
  // (x − centre)ᵀ M⁻¹ (x − centre) = 1; along a normal n it reaches √(nᵀ M n) from its centre.
  const Eigen::Vector3d centre(k[6], k[7], k[8]);
  Eigen::Matrix3d dual;
  dual << k[0], k[3], k[4], k[3], k[1], k[5], k[4], k[5], k[2];
  const Eigen::Matrix3d m = centre * centre.transpose() - dual;
  const Eigen::LLT<Eigen::Matrix3d> positive(m);
  if (positive.info() != Eigen::Success) return std::nullopt;
  double misses = 0, reaches = 0;
  for (const TangentPlane& plane : planes) {
    const double reach = std::sqrt(plane.normal.dot(m * plane.normal));
    const double miss = plane.offset / scale - centre.dot(plane.normal) - reach;
    misses += miss * miss;
    reaches += reach * reach;
  }
  if (!(misses <= kMostMiss * kMostMiss * reaches)) return std::nullopt;
  EndQuadric quadric;
  quadric.a = m.inverse();
  quadric.b = -scale * quadric.a * centre;
  quadric.c = scale * scale * (centre.dot(quadric.a * centre) - 1);
  return quadric;
}

}  // namespace frond
