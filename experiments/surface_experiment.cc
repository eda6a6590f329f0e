// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/surface_experiment.h"

#include "base/errors.h"
#include "experiments/sheet_metrics.h"
#include "models/nurbs_operations.h"
#include "problems/surface/outliers.h"
#include "problems/surface/principal_axes.h"
#include "problems/surface/sheet_fit.h"

namespace frond {
namespace {

FitOutcome RunSurface(const RunInput& input, const Options& problem, const Solver& solver,
                      const Budget& budget, const SolveContext& context) {
  StageClock clock;
  const SheetFitOptions options = SheetFitOptionsFrom(problem);
  const std::vector<Eigen::Vector3d>& points = input.cloud.points;
  // Strays are found in the axes of all points and have no say in the final ones.
  const auto in_axes = [&](const PrincipalAxes& axes) {
    std::vector<Eigen::Vector3d> local;
    local.reserve(points.size());
    for (const auto& point : points) local.push_back(axes.axes.transpose() * (point - axes.origin));
    return local;
  };
  std::vector<std::uint8_t> stray(points.size(), 0);
  stray = StrayPoints(in_axes(FindPrincipalAxes(points, stray)));
  PrincipalAxes axes = FindPrincipalAxes(points, stray);
  // Signs by the skewness, so that the same sheet in any pose is fitted in the same frame.
  Eigen::Vector3d skewness = Eigen::Vector3d::Zero();
  for (const auto& point : in_axes(axes)) skewness += point.array().cube().matrix();
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (skewness[axis] < 0) axes.axes.col(axis) *= -1;
  }
  axes.axes.col(2) = axes.axes.col(0).cross(axes.axes.col(1));
  const std::vector<Eigen::Vector3d> local = in_axes(axes);
  FitOutcome outcome;
  clock.End("frame");
  outcome.stages = clock.stages();
  SheetFit fit = FitSheet(local, stray, std::nullopt, options, solver, budget, context);
  SetSheetFit(fit, &outcome);
  Eigen::Isometry3d to_input = Eigen::Isometry3d::Identity();
  to_input.linear() = axes.axes;
  to_input.translation() = axes.origin;
  outcome.surface = TrimmedSurface{Transformed(fit.surface.surface, to_input), std::move(fit.surface.trim)};
  SetTruth(input, context.threads, &outcome);
  return outcome;
}

}  // namespace

FitType SurfaceFitType() {
  return {.name = "surface",
          .help = "A NURBS surface over an open sheet of points, by least orthogonal distances",
          .options = SheetFitSpecs(),
          .solver_defaults =
              [](const Options& problem, const std::string& solver) {
                return SheetFitSolverDefaults(solver, SheetFitOptionsFrom(problem));
              },
          .check = CheckSheetOptions,
          .run = RunSurface};
}

}  // namespace frond
