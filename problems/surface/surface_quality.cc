// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/surface_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "models/foot_point_search.h"
#include "models/surface_integrals.h"

namespace frond {
namespace {

constexpr std::size_t kChunk = 512;
constexpr int kSurfaceSamples = 40000;  // over the whole domain, about

double Percentile(std::vector<double>* values, double share) {
  if (values->empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + k, values->end());
  return (*values)[static_cast<std::size_t>(k)];
}

// A regular grid of samples over the domain, at cell centres.
struct SampleGrid {
  int nu, nv;
  std::vector<Eigen::Vector3d> position, area_normal;  // S, S_u × S_v
  std::vector<std::uint8_t> inside;
};

SampleGrid SampleSurface(const TrimmedSurface& trimmed, int threads) {
  const SurfaceCells cells(trimmed.surface);
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  SampleGrid grid;
  const int side = static_cast<int>(std::sqrt(kSurfaceSamples));
  grid.nu = grid.nv = side;
  const std::size_t total = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  grid.position.resize(total);
  grid.area_normal.resize(total);
  grid.inside.resize(total);
  ParallelFor(static_cast<std::size_t>(side), 1, threads, [&](std::size_t i, std::size_t) {
    const double u = bu.begin() + (bu.end() - bu.begin()) * (static_cast<double>(i) + 0.5) / side;
    const std::vector<double> crossings = TrimCrossings(trimmed.trim, u);
    for (int j = 0; j < side; ++j) {
      const double v = bv.begin() + (bv.end() - bv.begin()) * (j + 0.5) / side;
      const std::size_t k = i * static_cast<std::size_t>(side) + static_cast<std::size_t>(j);
      const SurfaceCells::Jet1 jet = cells.Evaluate1(u, v);
      grid.position[k] = jet.position;
      grid.area_normal[k] = jet.du.cross(jet.dv);
      const auto below = std::lower_bound(crossings.begin(), crossings.end(), v) - crossings.begin();
      grid.inside[k] = trimmed.trim.empty() || below % 2 == 1;
    }
  });
  return grid;
}

// The part of the grid that each sample belongs to: neighbours whose normals are less than 90° apart belong
// together. −1 where there is no normal. `areas`: of each part's samples inside the trim. Samples outside it
// count for the connection, so that narrow places do not part a surface.
std::vector<int> PartsByNormal(const SampleGrid& grid, std::vector<double>* areas) {
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * grid.nv + j); };
  std::vector<int> part(grid.area_normal.size(), -1);
  std::vector<std::pair<int, int>> stack;
  for (int seed = 0; seed < grid.nu * grid.nv; ++seed) {
    const auto s = static_cast<std::size_t>(seed);
    if (part[s] >= 0 || grid.area_normal[s].isZero()) continue;
    const int number = static_cast<int>(areas->size());
    areas->push_back(0);
    part[s] = number;
    stack.assign(1, {seed / grid.nv, seed % grid.nv});
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      const Eigen::Vector3d& normal = grid.area_normal[at(i, j)];
      if (grid.inside[at(i, j)]) areas->back() += normal.norm();
      const std::array<std::pair<int, int>, 4> beside = {{{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}};
      for (const auto& [k, l] : beside) {
        if (k < 0 || l < 0 || k >= grid.nu || l >= grid.nv || part[at(k, l)] >= 0) continue;
        if (normal.dot(grid.area_normal[at(k, l)]) <= 0) continue;
        part[at(k, l)] = number;
        stack.emplace_back(k, l);
      }
    }
  }
  return part;
}

// The sum of S_u × S_v over the samples inside in the 9 × 9 window round (i, j).
Eigen::Vector3d WindowSum(const SampleGrid& grid, int i, int j) {
  constexpr int kReach = 4;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = std::max(0, i - kReach); k <= std::min(grid.nu - 1, i + kReach); ++k) {
    for (int l = std::max(0, j - kReach); l <= std::min(grid.nv - 1, j + kReach); ++l) {
      const auto at = static_cast<std::size_t>(k * grid.nv + l);
      if (grid.inside[at]) sum += grid.area_normal[at];
    }
  }
  return sum;
}

// Samples inside that have turned over: beyond a crease, that is outside the part of the largest area, or
// against their surroundings, where a small fold's normals turn step by step.
int CountFlipped(const SampleGrid& grid) {
  std::vector<double> areas;
  const std::vector<int> part = PartsByNormal(grid, &areas);
  const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
  int flipped = 0;
  for (int i = 0; i < grid.nu; ++i) {
    for (int j = 0; j < grid.nv; ++j) {
      const auto at = static_cast<std::size_t>(i * grid.nv + j);
      if (!grid.inside[at] || part[at] < 0) continue;
      if (part[at] != largest || WindowSum(grid, i, j).dot(grid.area_normal[at]) < 0) ++flipped;
    }
  }
  return flipped;
}

void JudgePoints(const std::vector<std::uint8_t>& outlier, const std::vector<double>& signed_distance,
                 SurfaceQuality* quality) {
  std::vector<double> distances;
  distances.reserve(signed_distance.size());
  double squared = 0, inlier_squared = 0;
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < signed_distance.size(); ++i) {
    const double d = std::abs(signed_distance[i]);
    distances.push_back(d);
    squared += d * d;
    quality->mean += d;
    quality->max = std::max(quality->max, d);
    if (!outlier.empty() && outlier[i]) continue;
    ++inliers;
    inlier_squared += d * d;
    quality->inlier_max = std::max(quality->inlier_max, d);
  }
  const auto n = static_cast<double>(signed_distance.size());
  quality->rmse = std::sqrt(squared / n);
  quality->mean /= n;
  quality->inlier_rmse = inliers > 0 ? std::sqrt(inlier_squared / static_cast<double>(inliers)) : 0;
  quality->p95 = Percentile(&distances, 0.95);
}

// The distance to the nearest point that counts, among the eight nearest.
double DistanceToData(const KdTree& tree, const std::vector<std::uint8_t>& outlier,
                      const Eigen::Vector3d& query) {
  if (outlier.empty()) return std::sqrt(tree.Nearest(query).squared_distance);
  std::array<KdTree::Neighbour, 8> neighbours;
  const std::size_t found = tree.Nearest(query, neighbours);
  for (std::size_t k = 0; k < found; ++k) {
    if (!outlier[neighbours[k].index]) return std::sqrt(neighbours[k].squared_distance);
  }
  return std::sqrt(neighbours[found - 1].squared_distance);
}

}  // namespace

PointDistances MeasureDistances(std::span<const Eigen::Vector3d> points, const NurbsSurface& surface,
                                int threads, int seeds) {
  const SurfaceCells cells(surface);
  const FootPointSearch search(cells);
  PointDistances result;
  result.signed_distance.resize(points.size());
  result.feet.resize(points.size());
  result.offsets.resize(points.size());
  ParallelFor(points.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FootPoint foot = search.Find(points[i], seeds);
      const SurfaceCells::Jet1 jet = cells.Evaluate1(foot.u, foot.v);
      result.offsets[i] = points[i] - jet.position;
      const bool below = result.offsets[i].dot(jet.du.cross(jet.dv)) < 0;
      result.signed_distance[i] = (below ? -1 : 1) * std::sqrt(foot.squared_distance);
      result.feet[i] = {foot.u, foot.v};
    }
  });
  return result;
}

std::vector<Eigen::Vector3d> SurfaceSamples(const TrimmedSurface& surface, int threads) {
  const SampleGrid grid = SampleSurface(surface, threads);
  std::vector<Eigen::Vector3d> samples;
  for (std::size_t k = 0; k < grid.position.size(); ++k) {
    if (grid.inside[k]) samples.push_back(grid.position[k]);
  }
  return samples;
}

SurfaceQuality JudgeSurface(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& outlier,
                            const PointDistances& distances, const TrimmedSurface& surface,
                            const ScanResolution& scan, const KdTree& tree, int threads) {
  SurfaceQuality quality;
  if (points.empty()) return quality;
  JudgePoints(outlier, distances.signed_distance, &quality);
  const SampleGrid grid = SampleSurface(surface, threads);
  std::vector<double> reverse(grid.position.size(), -1);
  ParallelFor(reverse.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (grid.inside[k]) reverse[k] = DistanceToData(tree, outlier, grid.position[k]);
    }
  });
  double area = 0, covered = 0;
  std::vector<double> inside;
  for (std::size_t k = 0; k < reverse.size(); ++k) {
    if (reverse[k] < 0) continue;
    const double part = grid.area_normal[k].norm();
    area += part;
    if (reverse[k] <= 3 * scan.spacing) covered += part;
    inside.push_back(reverse[k]);
    quality.reverse_max = std::max(quality.reverse_max, reverse[k]);
  }
  quality.surface_samples = static_cast<int>(inside.size());
  quality.reverse_p95 = Percentile(&inside, 0.95);
  quality.data_coverage = area > 0 ? covered / area : 0;
  quality.flipped_normals = CountFlipped(grid);
  quality.area = Area(surface);
  quality.local_noise = scan.noise;
  quality.point_spacing = scan.spacing;
  return quality;
}

}  // namespace frond
