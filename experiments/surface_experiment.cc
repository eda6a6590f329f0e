// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/surface_experiment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.h"
#include "base/option_specs.h"
#include "experiments/surface_metrics.h"
#include "models/nurbs_operations.h"
#include "problems/surface/cloud_topology.h"
#include "problems/surface/outliers.h"
#include "problems/surface/principal_axes.h"
#include "problems/surface/surface_fit.h"

namespace frond {
namespace {

std::vector<OptionSpec> Specs() {
  std::vector<OptionSpec> specs = SurfaceFitSpecs();
  specs.push_back(
      ChoiceSpec("topology", {"auto", "sheet", "tube", "cup", "sphere"},
                 "What the input is: an open sheet, a tube (two rims), a cup (a pole and a rim) or "
                 "a sphere (two poles); auto: found from it"));
  specs.push_back(
      {.name = "fit.start",
       .type = OptionType::kChoice,
       .default_value = std::string("rectangle"),
       .help = "The surface that a sheet's distance fit starts from, by a rectangle of parameters (the "
               "outline where conforming): with all weights 1, or weights by Ma's two steps",
       .words = {"rectangle", "ma"}});
  return specs;
}

std::optional<SurfaceTopology> TopologyAskedFor(const Options& problem) {
  static const std::map<std::string, SurfaceTopology> topologies = {{"sheet", SurfaceTopology::kSheet},
                                                                    {"tube", SurfaceTopology::kTube},
                                                                    {"cup", SurfaceTopology::kCup},
                                                                    {"sphere", SurfaceTopology::kSphere}};
  const auto asked = topologies.find(problem.Text("topology"));
  return asked == topologies.end() ? std::nullopt : std::optional(asked->second);
}

SurfaceFitOptions FitOptionsFrom(const Options& problem) {
  SurfaceFitOptions options = SurfaceFitOptionsFrom(problem);
  options.start_from_ma = problem.Text("fit.start") == "ma";
  return options;
}

void Check(const Options& problem) {
  CheckSurfaceFitOptions(problem);
  const std::optional<SurfaceTopology> asked = TopologyAskedFor(problem);
  if (!asked) return;
  SurfaceFitOptions options = FitOptionsFrom(problem);
  options.topology = *asked;
  CheckTopologyOptions(options);
}

// Principal axes whose strays have no say, the x axis along a sheet or tube and through a sphere's poles;
// signs by the skewness, so that the same object in any pose is fitted in the same frame.
struct Frame {
  Eigen::Isometry3d to_input = Eigen::Isometry3d::Identity();
  std::vector<std::uint8_t> stray;
  std::vector<Eigen::Vector3d> points;
};

Frame FindFrame(const std::vector<Eigen::Vector3d>& points, SurfaceTopology topology) {
  Frame frame;
  const auto in_axes = [&](const PrincipalAxes& axes) {
    std::vector<Eigen::Vector3d> local;
    local.reserve(points.size());
    for (const auto& point : points) local.push_back(axes.axes.transpose() * (point - axes.origin));
    return local;
  };
  frame.stray.assign(points.size(), 0);
  frame.stray = StrayPoints(in_axes(FindPrincipalAxes(points, frame.stray)));
  PrincipalAxes axes = FindPrincipalAxes(points, frame.stray);
  const Eigen::Vector3d& d = axes.deviations;
  if (topology == SurfaceTopology::kSphere && d[0] * d[2] < d[1] * d[1]) {  // flat rather than long
    axes.axes.col(0).swap(axes.axes.col(2));
  }
  Eigen::Vector3d skewness = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> local = in_axes(axes);
  for (std::size_t i = 0; i < local.size(); ++i) {
    if (!frame.stray[i]) skewness += local[i].array().cube().matrix();
  }
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (skewness[axis] < 0) axes.axes.col(axis) *= -1;
  }
  axes.axes.col(2) = axes.axes.col(0).cross(axes.axes.col(1));
  frame.points = in_axes(axes);
  frame.to_input.linear() = axes.axes;
  frame.to_input.translation() = axes.origin;
  return frame;
}

// The mesh's longest boundary loops in the frame: one of a cup, two of a tube, in the order of x.
std::vector<Ring> RimsOfMesh(const RunInput& input, SurfaceTopology topology, const Frame& frame) {
  if (!input.mesh || topology == SurfaceTopology::kSheet || topology == SurfaceTopology::kSphere) return {};
  const MeshTopology mesh = FindMeshTopology(*input.mesh);
  const Eigen::Isometry3d from_input = frame.to_input.inverse();
  std::vector<Ring> rims;
  for (std::size_t k = 0; k < (topology == SurfaceTopology::kTube ? 2 : 1); ++k) {
    rims.emplace_back();
    for (const int vertex : mesh.boundary_loops.at(k)) {
      rims.back().push_back(from_input * input.mesh->vertices[static_cast<std::size_t>(vertex)]);
    }
  }
  const auto mean_x = [](const Ring& ring) {
    double sum = 0;
    for (const auto& point : ring) sum += point.x();
    return sum / static_cast<double>(ring.size());
  };
  if (rims.size() == 2 && mean_x(rims[1]) < mean_x(rims[0])) rims[0].swap(rims[1]);
  return rims;
}

FitOutcome RunSurface(const RunInput& input, const Options& problem, const Solver& solver,
                      const Budget& budget, const SolveContext& context) {
  StageClock clock;
  SurfaceFitOptions options = FitOptionsFrom(problem);
  TakeMeshAsItIs(input, problem, &options);
  const std::vector<Eigen::Vector3d>& points = input.cloud.points;
  const std::optional<SurfaceTopology> asked = TopologyAskedFor(problem);
  if (input.mesh || !asked) {
    options.topology =
        ChooseTopology(input.mesh ? FindSurfaceTopology(*input.mesh, FindMeshTopology(*input.mesh))
                                  : FindSurfaceTopology(points),
                       asked);
    clock.End("topology");
  } else {
    options.topology = *asked;
  }
  const Frame frame = FindFrame(points, options.topology);
  options.rims = RimsOfMesh(input, options.topology, frame);
  FitOutcome outcome;
  clock.End("frame");
  outcome.stages = clock.stages();
  SurfaceFit fit = FitSurface(frame.points, frame.stray, std::nullopt, options, solver, budget, context);
  SetSurfaceFit(fit, &outcome);
  outcome.metrics.Set("topology", std::string(SurfaceTopologyName(options.topology)));
  SetUncertainty(fit.uncertainty, frame.to_input, &outcome);
  outcome.surface =
      TrimmedSurface{Transformed(fit.surface.surface, frame.to_input), std::move(fit.surface.trim)};
  SetTruth(input, context.threads, &outcome);
  SetVolumes(input, &outcome);
  SetMeshComparison(input, context.threads, &outcome);
  return outcome;
}

}  // namespace

FitType SurfaceFitType() {
  return {.name = "surface",
          .help = "A NURBS surface by least orthogonal distances: an open sheet, a tube, a cup or a sphere",
          .options = Specs(),
          .solver_defaults =
              [](const Options& problem, const std::string& solver) {
                SurfaceFitOptions options = SurfaceFitOptionsFrom(problem);
                // The same whether the topology is named or found.
                options.topology = SurfaceTopology::kTube;
                return SurfaceFitSolverDefaults(solver, options);
              },
          .check = Check,
          .run = RunSurface,
          .has_walls = true};
}

}  // namespace frond
