// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/surface_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "problems/surface/net_choice.h"
#include "problems/surface/scan_cloud.h"
#include "problems/surface/sheet_boundary.h"
#include "problems/surface/surface_fit_stages.h"
#include "solvers/report_sum.h"

namespace frond {
namespace {

void CheckInput(std::span<const Eigen::Vector3d> points, std::array<int, 2> net) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const Eigen::Vector3d size = points.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.sizes());
  if (points.size() < 4 || !(size.minCoeff() >= 0) || size.y() <= 1e-9 * size.x()) {
    throw InputError("the " + std::to_string(points.size()) +
                     " usable points have no extent in two directions; a surface needs an area");
  }
  CheckPointCount(points.size(), net);
}

// The net asked for or, with {0, 0}, the one chosen; `report` and `budget` then bear what the choice took.
std::array<int, 2> FindNet(const ScanCloud& cloud, const std::optional<NurbsSurface>& start,
                           const SurfaceFitOptions& options, const Solver& solver,
                           const SolveContext& context, Budget* budget, SolverReport* report) {
  if (options.control_points[0] > 0) return options.control_points;
  const NetChoice choice =
      ChooseNet(cloud.inliers(), start, options, cloud.resolution(), solver, *budget, context);
  *report = choice.report;
  budget->max_evaluations -= report->evaluations;
  budget->max_seconds -= report->seconds;
  return choice.net;
}

FitUncertainty UncertaintyOf(const std::vector<Eigen::Vector3d>& points, const TrimmedSurface& surface,
                             const DistanceFitOptions& options, int threads) {
  constexpr int kSegments = 64;  // along the domain, about
  const auto spans = std::max(surface.surface.u().spans().size(), surface.surface.v().spans().size());
  SurfaceMesh mesh = Tessellate(surface, std::max(2, kSegments / static_cast<int>(spans)));
  SurfaceUncertainty estimate =
      EstimateUncertainty(points, surface.surface, options, mesh.parameters, mesh.normals, threads);
  return {std::move(mesh), std::move(estimate)};
}

}  // namespace

void CheckPointCount(std::size_t points, std::array<int, 2> control_points) {
  const auto [u, v] = control_points;
  if (static_cast<std::size_t>(u) * static_cast<std::size_t>(v) <= points) return;
  const auto most = std::to_string(static_cast<int>(std::sqrt(static_cast<double>(points))));
  throw InputError(std::to_string(points) + " usable points cannot hold " + std::to_string(u) + " x " +
                   std::to_string(v) + " control points; set surface.control_points to at most " + most +
                   " x " + most);
}

SurfaceFit FitSurface(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                      const std::optional<NurbsSurface>& start, const SurfaceFitOptions& options,
                      const Solver& solver, const Budget& budget, const SolveContext& context) {
  CheckTopologyOptions(options);
  StageClock clock;
  const int least = std::max({options.degree[0], options.degree[1], 4}) + 1;
  const bool automatic = options.control_points[0] == 0;
  CheckInput(points, automatic ? std::array<int, 2>{least, least} : options.control_points);
  const bool find_outliers = options.outlier_threshold > 0;
  ScanCloud cloud(points, find_outliers ? stray : std::vector<std::uint8_t>());
  clock.End("points");

  Budget left = budget;
  SolverReport choice;
  const std::array<int, 2> net = FindNet(cloud, start, options, solver, context, &left, &choice);
  CheckInput(cloud.inliers(), net);
  if (automatic) clock.End("choose_net");

  SurfaceFitStages stages(options, net, cloud.resolution(), solver, left, context);
  NurbsSurface surface = stages.Fit(&cloud.inliers(), start, [&](const PointDistances& distances) {
    return find_outliers && cloud.RemoveOutliers(distances.offsets, options.outlier_threshold);
  });
  clock.End("fit");
  const PointDistances distances = MeasureDistances(cloud.points(), surface, context.threads);
  if (find_outliers) cloud.JudgeOutliers(distances.offsets, options.outlier_threshold);
  clock.End("distances");

  SurfaceFit result{.surface = {std::move(surface), {}},
                    .control_points = net,
                    .margin = stages.margin(),
                    .outlier = {},
                    .distances = {},
                    .quality = {},
                    .errors = {},
                    .uncertainty = {},
                    .report = stages.report(),
                    .stages = {},
                    .warnings = {}};
  AddCost(choice, &result.report);
  if (result.margin == MarginMode::kTrim) {
    std::vector<Eigen::Vector2d> feet;
    for (std::size_t i = 0; i < distances.feet.size(); ++i) {
      if (!cloud.outlier()[i]) feet.push_back(distances.feet[i]);
    }
    TrimLoop loop = BoundaryOfFeet(feet, result.surface.surface, cloud.resolution().spacing);
    if (loop.size() >= 3) {
      result.surface.trim.push_back(std::move(loop));
    } else {
      result.warnings.emplace_back("the feet have no clear boundary: the surface is left untrimmed");
    }
    clock.End("trim");
  }
  result.quality = JudgeSurface(cloud.points(), cloud.outlier(), distances, result.surface,
                                cloud.resolution(), cloud.tree(), context.threads);
  // Of a distance fit the parameters are the feet.
  std::vector<Eigen::Vector2d> parameters;
  if (options.method != SurfaceMethod::kDistance) parameters = stages.Parameters(cloud.points());
  result.errors = MeasureSurfaceErrors(cloud.points(), parameters, distances, result.surface,
                                       cloud.resolution().spacing, context.threads);
  if (parameters.empty()) {
    result.errors.parametric_total = result.errors.perpendicular_total;
    result.errors.parametric_mean = result.errors.perpendicular_mean;
  }
  result.outlier = cloud.InGivenOrder(cloud.outlier());
  result.distances = {cloud.InGivenOrder(distances.signed_distance), cloud.InGivenOrder(distances.feet),
                      cloud.InGivenOrder(distances.offsets)};
  clock.End("quality");
  if (options.uncertainty) {
    result.uncertainty =
        UncertaintyOf(cloud.inliers(), result.surface, stages.last_options(), context.threads);
    clock.End("uncertainty");
  }
  result.stages = clock.stages();
  return result;
}

FitJudgement JudgeFit(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                      const TrimmedSurface& surface, int threads) {
  const ScanCloud cloud(points, stray);
  const PointDistances distances = MeasureDistances(cloud.points(), surface.surface, threads);
  return {JudgeSurface(cloud.points(), cloud.outlier(), distances, surface, cloud.resolution(), cloud.tree(),
                       threads),
          MeasureSurfaceErrors(cloud.points(), {}, distances, surface, cloud.resolution().spacing, threads),
          {cloud.InGivenOrder(distances.signed_distance), cloud.InGivenOrder(distances.feet),
           cloud.InGivenOrder(distances.offsets)}};
}

}  // namespace frond
