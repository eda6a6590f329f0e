// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "models/foot_point_search.h"
#include "models/kd_tree.h"
#include "models/nurbs_surface.h"

namespace frond {

// How well a surface and a cloud agree, judged both ways (MATH.md §1, "Distance alone is cheated"). Lengths
// in the cloud's unit.
struct SurfaceQuality {
  double rmse = 0, max = 0, mean = 0, p95 = 0;  // every point to the surface, orthogonal, global search
  double inlier_rmse = 0, inlier_max = 0;       // of the points not marked as outliers
  double reverse_p95 = 0, reverse_max = 0;      // surface samples inside the trim to the nearest inlier
  double area = 0;                              // inside the trim
  int flipped_normals = 0;                      // samples inside the trim that lie beyond a fold: turned over
  int surface_samples = 0;                      // inside the trim
  double data_coverage = 0;                     // share of the area with a point within 3 spacings
  double local_noise = 0;                       // of the scan itself (LocalNoise)
  double point_spacing = 0;                     // of the scan (PointSpacing)
};

// Distance of every point to the surface (the whole of it: also feet outside the trim count), negative below
// it as its normal sees it, the feet, and the points less their feet's positions.
struct PointDistances {
  std::vector<double> signed_distance;
  std::vector<Eigen::Vector2d> feet;
  std::vector<Eigen::Vector3d> offsets;
};
// `seeds` starts a point (FootPointSearch::Find).
PointDistances MeasureDistances(std::span<const Eigen::Vector3d> points, const NurbsSurface& surface,
                                int threads, int seeds = FootPointSearch::kThorough);

// What a scan can tell at most.
struct ScanResolution {
  double spacing = 0;  // PointSpacing
  double noise = 0;    // LocalNoise
};

// A regular grid of samples over the domain, about 40,000, those inside the trim.
std::vector<Eigen::Vector3d> SurfaceSamples(const TrimmedSurface& surface, int threads);

// `outlier`: 1 for points that do not count as data (may be empty: none). `tree` holds `points`.
SurfaceQuality JudgeSurface(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& outlier,
                            const PointDistances& distances, const TrimmedSurface& surface,
                            const ScanResolution& scan, const KdTree& tree, int threads);

}  // namespace frond
