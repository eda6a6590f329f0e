// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/voxel_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/random.h"

namespace frond {
namespace {

constexpr int kBits = 21;  // of a cube's number along each axis

Eigen::AlignedBox3d BoxOf(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box;
}

// The cube of each point, as one number.
std::vector<std::uint64_t> CubesOf(std::span<const Eigen::Vector3d> points, double edge,
                                   const Eigen::Vector3d& corner) {
  const Eigen::AlignedBox3d box = BoxOf(points);
  // The grid's corner nearest below all points.
  const Eigen::Vector3d first = ((box.min() - corner) / edge).array().floor();
  if ((box.sizes() / edge).maxCoeff() + 2 >= std::ldexp(1.0, kBits)) {
    throw InputError("the voxel grid's edge is too small for the cloud's size");
  }
  std::vector<std::uint64_t> cubes;
  cubes.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d place = (((p - corner) / edge).array().floor() - first.array()).max(0);
    cubes.push_back((static_cast<std::uint64_t>(place.x()) << (2 * kBits)) |
                    (static_cast<std::uint64_t>(place.y()) << kBits) | static_cast<std::uint64_t>(place.z()));
  }
  return cubes;
}

std::size_t CountCubes(std::span<const Eigen::Vector3d> points, double edge, const Eigen::Vector3d& corner) {
  std::vector<std::uint64_t> cubes = CubesOf(points, edge, corner);
  std::sort(cubes.begin(), cubes.end());
  return static_cast<std::size_t>(std::unique(cubes.begin(), cubes.end()) - cubes.begin());
}

}  // namespace

std::vector<Eigen::Vector3d> VoxelGridMeans(std::span<const Eigen::Vector3d> points, double edge,
                                            const Eigen::Vector3d& corner) {
  if (!(edge > 0)) throw ConfigError("a voxel grid's edge must be above 0");
  if (points.empty()) return {};
  const std::vector<std::uint64_t> cubes = CubesOf(points, edge, corner);
  std::vector<std::pair<std::uint64_t, std::size_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) sorted.emplace_back(cubes[i], i);
  std::sort(sorted.begin(), sorted.end());
  std::vector<Eigen::Vector3d> means;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (; end < sorted.size() && sorted[end].first == sorted[begin].first; ++end) {
      sum += points[sorted[end].second] - corner;
    }
    means.push_back(corner + sum / static_cast<double>(end - begin));
  }
  return means;
}

std::vector<Eigen::Vector3d> DownsampleByVoxelGrid(std::span<const Eigen::Vector3d> points, std::size_t count,
                                                   std::uint64_t seed) {
  if (points.size() <= count) return {points.begin(), points.end()};
  if (count == 0) throw ConfigError("a voxel grid cannot leave 0 points");
  Random random = Random::ForKey(seed, "voxel grid");
  const Eigen::Vector3d place(random.Uniform(), random.Uniform(), random.Uniform());
  const Eigen::AlignedBox3d box = BoxOf(points);
  const auto corner = [&](double edge) -> Eigen::Vector3d { return box.min() - edge * place; };
  // Too many cubes at `low`, too few at `high`.
  double high = 2 * box.sizes().maxCoeff(), low = high * 1e-5, best = high;
  std::size_t best_error = points.size();
  for (int i = 0; i < 40 && best_error > 0; ++i) {
    const double edge = std::sqrt(low * high);
    const std::size_t cubes = CountCubes(points, edge, corner(edge));
    const std::size_t error = cubes > count ? cubes - count : count - cubes;
    if (error < best_error) {
      best_error = error;
      best = edge;
    }
    (cubes > count ? low : high) = edge;
  }
  return VoxelGridMeans(points, best, corner(best));
}

}  // namespace frond
