// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/leaf_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/errors.h"
#include "experiments/surface_metrics.h"
#include "io/length_unit.h"
#include "models/nurbs_operations.h"
#include "problems/leaf/leaf_options.h"
#include "problems/leaf/leaf_paper_fit.h"
#include "problems/surface/surface_fit.h"

namespace frond {
namespace {

std::vector<OptionSpec> Specs() {
  std::vector<OptionSpec> specs = LeafSpecs();
  for (OptionSpec& spec : SurfaceFitSpecs()) specs.push_back(std::move(spec));
  specs.push_back(
      {.name = "fit.start",
       .type = OptionType::kChoice,
       .default_value = std::string("auto"),
       .help = "Where the distance fit starts: the paper's surface, or a rectangle (the outline where "
               "conforming); auto: paper where conforming, else rectangle",
       .words = {"auto", "paper", "rectangle"}});
  specs.push_back({.name = "fit.tie_tip",
                   .type = OptionType::kFlag,
                   .default_value = true,
                   .help = "Conforming: the surface's edge at the leaf's tip is one point"});
  return specs;
}

constexpr double kWeightsRadius = 10;

// The paper's own net and degrees, for its method.
OptionDefaults DependentDefaults(const Options& problem) {
  if (LeafMethodFrom(problem) != LeafMethod::kPaper) return {};
  return {{"surface.degree", std::vector<double>{2, 2}},
          {"surface.control_points", std::vector<double>{5, 5}}};
}

std::array<int, 2> PairOf(const Options& problem, const std::string& name) {
  const std::vector<int> values = problem.Integers(name);
  return {values.front(), values.back()};
}

double MillimetresPer(const std::string& unit) { return 1000 * MetresPerUnit(unit); }

LeafPaperOptions PaperOptions(const Options& problem, const std::string& unit) {
  const auto degree = PairOf(problem, "surface.degree"), net = PairOf(problem, "surface.control_points");
  return LeafPaperOptionsFrom(problem, {degree[0], degree[1]}, {net[0], net[1]}, MillimetresPer(unit));
}

// The paper's surface as a start: of the degrees and net asked for, or as many control points as its point
// set can tell (a row of the ordered kind across, the selected slices along; 5 x 5 where the net is chosen
// later).
LeafPaperOptions PaperStartOptions(const Options& problem, const std::string& unit) {
  const PointSetOptions set = PointSetOptionsFrom(problem);
  const std::array<int, 2> most = {set.left + set.right + 3, set.selected};
  auto degree = PairOf(problem, "surface.degree");
  std::array<int, 2> net = {5, 5};
  if (!problem.HoldsWord("surface.control_points")) net = PairOf(problem, "surface.control_points");
  for (const std::size_t k : {0, 1}) {
    net[k] = std::min(net[k], most[k]);
    degree[k] = std::min(degree[k], net[k] - 1);
  }
  LeafPaperOptions options =
      LeafPaperOptionsFrom(problem, {degree[0], degree[1]}, {net[0], net[1]}, MillimetresPer(unit));
  options.free_weights = false;
  return options;
}

void Check(const Options& problem) {
  if (LeafMethodFrom(problem) == LeafMethod::kPaper) {
    if (problem.HoldsWord("surface.control_points")) {
      throw ConfigError("option 'surface.control_points' is auto, which 'method: paper' does not know");
    }
    (void)PaperOptions(problem, "mm");
    return;
  }
  CheckSurfaceFitOptions(problem);
  CheckTopologyOptions(SurfaceFitOptionsFrom(problem));
}

// Before the frame, whose own complaint about fewer than 10 points comes first.
void CheckLeafPointCount(const RunInput& input, std::array<int, 2> control_points) {
  if (input.cloud.points.size() >= 10) CheckPointCount(input.cloud.points.size(), control_points);
}

// A cloud in its leaf's frame.
struct InFrame {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint8_t> stray;  // 1 for the frame's strays
  Eigen::Isometry3d to_input = Eigen::Isometry3d::Identity();
};

InFrame ToFrame(const std::vector<Eigen::Vector3d>& points, const LeafFrame& frame) {
  InFrame local;
  local.points.reserve(points.size());
  for (const auto& point : points) local.points.push_back(frame.FromInput(point));
  local.stray.assign(points.size(), 0);
  for (const std::size_t i : frame.strays) local.stray[i] = 1;
  local.to_input.linear() = frame.axes;
  local.to_input.translation() = frame.origin;
  return local;
}

FitOutcome RunPaper(const RunInput& input, const Options& problem, const Solver& solver, const Budget& budget,
                    const SolveContext& context) {
  const LeafPaperOptions options = PaperOptions(problem, input.unit);
  CheckLeafPointCount(input, {options.surface.count_u, options.surface.count_v});
  LeafPaperFit fit = FitLeafAsInPaper(input.cloud.points, options, &solver, budget, context);
  FitOutcome outcome;
  outcome.stages = fit.stages;
  outcome.warnings = fit.warnings;
  outcome.report = fit.report;
  StageClock clock;
  const InFrame local = ToFrame(input.cloud.points, fit.frame);
  const NurbsSurface local_surface = Transformed(fit.surface, local.to_input.inverse());
  const FitJudgement judgement = JudgeFit(local.points, local.stray, {local_surface, {}}, context.threads);
  clock.End("quality");
  outcome.stages.push_back(clock.stages().front());
  SetQuality(judgement.quality, fit.surface, &outcome.metrics);
  SetErrors(judgement.errors, &outcome.metrics);
  outcome.signed_distances = judgement.distances.signed_distance;
  outcome.outlier = local.stray;
  outcome.metrics.Set(
      "outliers", static_cast<std::int64_t>(std::count(outcome.outlier.begin(), outcome.outlier.end(), 1)));
  outcome.metrics.Set("margin", std::string("none"));
  outcome.metrics.Set("test_points", static_cast<std::int64_t>(fit.test_points.size()));
  outcome.metrics.Set("test_rmse", fit.error.rmse);
  outcome.metrics.Set("test_max", fit.error.max);
  outcome.metrics.Set("test_objective", fit.error.objective);
  outcome.metrics.Set("unweighted_test_rmse", fit.unweighted.rmse);
  outcome.metrics.Set("unweighted_test_max", fit.unweighted.max);
  outcome.metrics.Set("unweighted_test_objective", fit.unweighted.objective);
  outcome.metrics.Set("point_set",
                      std::string(fit.point_set_kind == PointSetKind::kOrdered ? "ordered" : "unordered"));
  outcome.metrics.Set("midrib_offset", fit.midrib_offset);
  outcome.surface = TrimmedSurface{std::move(fit.surface), {}};
  SetTruth(input, context.threads, &outcome);
  SetMeshComparison(input, context.threads, &outcome);
  return outcome;
}

FitOutcome RunDistance(const RunInput& input, const Options& problem, const Solver& solver,
                       const Budget& budget, const SolveContext& context) {
  SurfaceFitOptions options = SurfaceFitOptionsFrom(problem);
  options.tie_tip = problem.Flag("fit.tie_tip");
  TakeMeshAsItIs(input, problem, &options);
  CheckLeafPointCount(input, options.control_points);
  FitOutcome outcome;
  StageClock clock;
  const LeafFrame frame = FindLeafFrame(input.cloud.points, LeafFrameOptionsFrom(problem));
  const InFrame local = ToFrame(input.cloud.points, frame);
  clock.End("frame");

  std::optional<NurbsSurface> start;
  const std::string& wanted = problem.Text("fit.start");
  const bool conforming =
      MarginFor(options, options.control_points) == MarginMode::kConforming && options.control_points[0] > 0;
  options.given_start_only = wanted == "paper";
  if (wanted == "paper" || (wanted == "auto" && conforming)) {
    LeafPaperFit fit =
        FitLeafAsInPaper(input.cloud.points, PaperStartOptions(problem, input.unit), nullptr, {}, context);
    for (std::string& warning : fit.warnings) outcome.warnings.push_back("start: " + std::move(warning));
    start = Transformed(fit.surface, local.to_input.inverse());
    clock.End("paper_start");
  }
  outcome.stages = clock.stages();
  SurfaceFit fit = FitSurface(local.points, local.stray, start, options, solver, budget, context);
  SetSurfaceFit(fit, &outcome);
  SetUncertainty(fit.uncertainty, local.to_input, &outcome);
  outcome.surface =
      TrimmedSurface{Transformed(fit.surface.surface, local.to_input), std::move(fit.surface.trim)};
  SetTruth(input, context.threads, &outcome);
  SetMeshComparison(input, context.threads, &outcome);
  return outcome;
}

FitOutcome Run(const RunInput& input, const Options& problem, const Solver& solver, const Budget& budget,
               const SolveContext& context) {
  return LeafMethodFrom(problem) == LeafMethod::kPaper ? RunPaper(input, problem, solver, budget, context)
                                                       : RunDistance(input, problem, solver, budget, context);
}

OptionDefaults SolverDefaults(const Options& problem, const std::string& solver) {
  if (LeafMethodFrom(problem) == LeafMethod::kDistance) {
    return SurfaceFitSolverDefaults(solver, SurfaceFitOptionsFrom(problem));
  }
  // A first step as long as weights may well move: Ceres's own radius of 1e4 is cut down for many iterations
  // first.
  if (solver == "lm") return {{"initial_trust_region_radius", kWeightsRadius}};
  if (solver == "pso_lm") return {{"lm.initial_trust_region_radius", kWeightsRadius}};
  return {};
}

}  // namespace

FitType LeafFitType() {
  return {.name = "leaf",
          .help =
              "A leaf's surface in its own frame: the paper's slices and B-spline (with weights by any "
              "solver), or the distance fit",
          .options = Specs(),
          .dependent_defaults = DependentDefaults,
          .solver_defaults = SolverDefaults,
          .check = Check,
          .run = Run};
}

}  // namespace frond
