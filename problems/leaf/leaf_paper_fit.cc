// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_paper_fit.h"

#include <stdexcept>
#include <utility>

#include "base/errors.h"

namespace frond {
namespace {

// Free weights, in frame coordinates; the solver's best.
NurbsSurface FitWeights(const NurbsSurface& surface, const std::vector<Eigen::Vector3d>& test_points,
                        const LeafWeightsOptions& options, const Solver& solver, const Budget& budget,
                        const SolveContext& context, SolverReport* report) {
  const LeafWeightsFit fit(surface, test_points, options);
  *report = solver.Solve(fit, budget, context);
  if (report->termination == Termination::kFailed) throw FitError("the leaf's weights: " + report->message);
  return fit.SurfaceAt(report->x);
}

std::string StrayWarning(std::size_t strays, std::size_t points) {
  return std::to_string(strays) + " of " + std::to_string(points) +
         " points stand far apart from the leaf and were left out";
}

}  // namespace

NurbsSurface ToInput(const NurbsSurface& surface, const LeafFrame& frame) {
  std::vector<Eigen::Vector3d> control = surface.control_points();
  for (Eigen::Vector3d& p : control) p = frame.ToInput(p);
  return NurbsSurface(surface.u(), surface.v(), std::move(control), surface.weights());
}

LeafPaperFit FitLeafAsInPaper(std::span<const Eigen::Vector3d> points, const LeafPaperOptions& options,
                              const Solver* solver, const Budget& budget, const SolveContext& context) {
  if (options.free_weights && solver == nullptr) {
    throw std::invalid_argument("FitLeafAsInPaper: free weights need a solver");
  }
  StageClock clock;
  const LeafFrame frame = FindLeafFrame(points, options.frame);
  const std::vector<Eigen::Vector3d> local = PointsInFrame(points, frame);
  clock.End("frame");
  PointSet set = MakePointSet(local, options.point_set);
  std::vector<Eigen::Vector3d> test_points = MakeTestSubset(local, options.test_subset);
  clock.End("point_set");
  NurbsSurface surface = FitLeafSurface(set, options.surface);
  clock.End("surface");
  const LeafError unweighted = MeasureLeaf(surface, test_points, options.weights.objective, context.threads);
  LeafError error = unweighted;
  std::optional<SolverReport> report;
  if (options.free_weights) {
    report.emplace();
    surface = FitWeights(surface, test_points, options.weights, *solver, budget, context, &*report);
    clock.End("weights");
    error = MeasureLeaf(surface, test_points, options.weights.objective, context.threads);
  }
  LeafPaperFit fit{.surface = ToInput(surface, frame), .frame = frame};
  fit.point_set_kind = set.kind;
  fit.midrib_offset = set.midrib_offset;
  fit.test_points = std::move(test_points);
  fit.unweighted = unweighted;
  fit.error = error;
  fit.report = std::move(report);
  fit.warnings = std::move(set.warnings);
  if (!fit.frame.strays.empty()) fit.warnings.push_back(StrayWarning(fit.frame.strays.size(), points.size()));
  for (Eigen::Vector3d& p : fit.test_points) p = fit.frame.ToInput(p);
  clock.End("metrics");
  fit.stages = clock.stages();
  return fit;
}

}  // namespace frond
