// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "models/nurbs_surface.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/surface_fit.h"
#include "solvers/solver.h"

namespace frond {

// A synthetic leaf scan in its leaf frame (x along the leaf, y across, z up), with its truth. mm. What tests
// and benchmarks of the sheet fit share.
struct LeafCase {
  LeafScan scan;                              // in the scanner's pose
  std::vector<Eigen::Vector3d> points;        // of the scan
  std::vector<Eigen::Vector3d> clean_points;  // where each of them was measured, without noise
  std::vector<Eigen::Vector3d> dense_clean;   // uniform by area over the whole blade
  LeafCharacter character = LeafCharacter::kSmooth;
};

// RandomLeaf(seed) in a random pose. `options` gives the number of points, noise, outliers and holes; its
// seeds and its pose are set here.
LeafCase MakeLeafCase(std::uint64_t seed, LeafScanOptions options);

// `lm` with the sheet fit's own defaults.
std::unique_ptr<Solver> SheetSolver(const SurfaceFitOptions& options);

SurfaceFit FitLeaf(std::span<const Eigen::Vector3d> points, const SurfaceFitOptions& options,
                   int threads = 1);

// Distances from clean truth to the whole surface, by global search from three seeds a point.
struct TruthErrors {
  double rmse = 0, max = 0;
};
TruthErrors ErrorsAgainst(std::span<const Eigen::Vector3d> truth, const NurbsSurface& surface,
                          int threads = 1);

}  // namespace frond
