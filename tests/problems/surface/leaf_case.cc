// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/surface/leaf_case.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "problems/leaf/leaf_frame.h"
#include "problems/surface/outliers.h"
#include "problems/surface/surface_quality.h"

namespace frond {

LeafCase MakeLeafCase(std::uint64_t seed, LeafScanOptions options) {
  options.seed = options.pose_seed = seed;
  options.random_pose = true;
  const LeafShape shape = RandomLeaf(seed);
  LeafCase leaf;
  leaf.scan = ScanLeaf(shape, options);
  leaf.character = shape.character;
  const LeafFrame frame = FindLeafFrame(leaf.scan.points);
  const auto into_frame = [&](const std::vector<Eigen::Vector3d>& points) {
    std::vector<Eigen::Vector3d> moved;
    moved.reserve(points.size());
    for (const Eigen::Vector3d& point : points) moved.push_back(frame.FromInput(point));
    return moved;
  };
  leaf.points = into_frame(leaf.scan.points);
  leaf.clean_points = into_frame(leaf.scan.clean_points);
  leaf.dense_clean = into_frame(leaf.scan.dense_clean);
  return leaf;
}

std::unique_ptr<Solver> SheetSolver(const SurfaceFitOptions& options) {
  const SolverType& type = FindSolverType("lm");
  Options solver_options(type.options);
  for (const auto& [name, value] : SurfaceFitSolverDefaults("lm", options)) solver_options.Set(name, value);
  return type.create(solver_options);
}

SurfaceFit FitLeaf(std::span<const Eigen::Vector3d> points, const SurfaceFitOptions& options, int threads) {
  return FitSurface(points, StrayPoints(points), std::nullopt, options, *SheetSolver(options), {},
                    {.threads = threads, .seed = 1});
}

TruthErrors ErrorsAgainst(std::span<const Eigen::Vector3d> truth, const NurbsSurface& surface, int threads) {
  TruthErrors errors;
  for (const double d : MeasureDistances(truth, surface, threads).signed_distance) {
    errors.rmse += d * d;
    errors.max = std::max(errors.max, std::abs(d));
  }
  errors.rmse = std::sqrt(errors.rmse / static_cast<double>(truth.size()));
  return errors;
}

}  // namespace frond
