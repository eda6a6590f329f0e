// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/turntable_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "base/parallel.h"
#include "experiments/board_views.h"
#include "experiments/match_outputs.h"
#include "experiments/named_errors.h"
#include "experiments/surface_metrics.h"
#include "experiments/turntable_calibration.h"
#include "models/mesh_distance.h"
#include "problems/turntable/turned_surface.h"
#include "problems/turntable/turntable_scan.h"

namespace frond {
namespace {

OptionSpec NumberOrWord(const std::string& name, const std::string& word, double minimum, double maximum,
                        const std::string& help) {
  OptionSpec spec = NumberSpec(name, 0, minimum, maximum, help);
  spec.default_value = word;
  spec.words = {word};
  return spec;
}

std::vector<OptionSpec> ScanSpecs() {
  const ObjectMaskOptions mask;
  const ViewCloudOptions cloud;
  const MergeOptions merge;
  return {
      NumberOrWord("pair_angle", "auto", 0.01, 90,
                   "Degrees of turn between the two views of a pair; auto: the smallest step of the views"),
      ChoiceSpec("mask.background", {"auto", "dark", "light", "none"},
                 "How the object is told from the background where a view has no mask; none: all is object"),
      NumberSpec("mask.opening", mask.opening, 0, 100,
                 "Pixels: thinner parts are taken for wires or glare, not for the object"),
      NumberSpec("cloud.least_cosine", cloud.least_cosine, 0, 1,
                 "Windows seen more slantingly (cosine to the normal) give no point"),
      NumberOrWord("cloud.least_height", "none", -1e9, 1e9,
                   "Points lower than this along the axis are left out: the disk"),
      ChoiceSpec("refine", {"none", "angle", "pose"},
                 "Correct each view by its overlaps with the others: its angle, or all of its pose"),
      NumberOrWord("merge.spacing", "auto", 1e-9, 1e9,
                   "Of the merged points; auto: that of the views' points"),
      NumberSpec("merge.reach", merge.reach, 0.5, 20, "Radius of the neighbourhoods, in spacings"),
      NumberSpec(
          "merge.outlier_sigmas", merge.outlier_sigmas, 0.5, 100,
          "Points farther off the surface of their neighbourhood, in standard deviations, are left out"),
      NumberSpec("merge.normal_agreement", merge.normal_agreement, -1, 1,
                 "Least cosine between normals of one surface"),
      FlagSpec("fit_surface", true, "Fit the closed surface; no: stop at the cloud")};
}

std::vector<OptionSpec> Specs() {
  std::vector<OptionSpec> specs = TurntableCalibrationSpecs();
  for (const std::vector<OptionSpec>& part : {ScanSpecs(), StereoMatchSpecs(), SurfaceFitSpecs()}) {
    specs.insert(specs.end(), part.begin(), part.end());
  }
  return specs;
}

SurfaceFitOptions SurfaceOptions(const Options& problem) {
  SurfaceFitOptions options = SurfaceFitOptionsFrom(problem);
  options.topology = SurfaceTopology::kSphere;
  return options;
}

void Check(const Options& problem) {
  const StereoMatchOptions match = StereoMatchOptionsFrom(problem);
  CheckStereoMatchOptions(match);
  if (!match.rectified)
    throw ConfigError("views of a turntable are made normal: leave 'match.rectified' out");
  if (problem.Flag("fit_surface")) {
    CheckSurfaceFitOptions(problem);
    CheckTopologyOptions(SurfaceOptions(problem));
  }
}

void CheckInput(const InputSource& input, const Options& problem) {
  CheckBoardOptions(problem, !input.photographs.board.empty());
}

TurntableScanOptions ScanOptionsFrom(const Options& problem) {
  TurntableScanOptions options;
  if (!problem.HoldsWord("pair_angle")) options.pairs.phi = problem.Number("pair_angle");
  constexpr std::pair<const char*, BackgroundKind> kBackgrounds[] = {{"auto", BackgroundKind::kAuto},
                                                                     {"dark", BackgroundKind::kDark},
                                                                     {"light", BackgroundKind::kLight},
                                                                     {"none", BackgroundKind::kNone}};
  for (const auto& [word, kind] : kBackgrounds) {
    if (problem.Text("mask.background") == word) options.mask.background = kind;
  }
  options.mask.opening = problem.Number("mask.opening");
  options.match = StereoMatchOptionsFrom(problem);
  options.cloud.least_cosine = problem.Number("cloud.least_cosine");
  if (!problem.HoldsWord("cloud.least_height")) {
    options.cloud.height_above_disk = problem.Number("cloud.least_height");
  }
  const std::string& refine = problem.Text("refine");
  if (refine != "none") {
    options.refinement.emplace();
    options.refinement->freedom = refine == "angle" ? PoseFreedom::kAngle : PoseFreedom::kPose;
  }
  if (!problem.HoldsWord("merge.spacing")) options.merge.spacing = problem.Number("merge.spacing");
  options.merge.reach = problem.Number("merge.reach");
  options.merge.outlier_sigmas = problem.Number("merge.outlier_sigmas");
  options.merge.normal_agreement = problem.Number("merge.normal_agreement");
  return options;
}

void WritePairs(const std::filesystem::path& path, const TurntableScan& scan) {
  std::vector<std::string> columns = {"left_angle", "right_angle",     "windows",     "accepted",
                                      "points",     "median_sigma_px", "median_sigma"};
  if (scan.refinement) columns.insert(columns.end(), {"angle_correction", "shift"});
  std::vector<std::vector<MetricValue>> rows;
  for (std::size_t k = 0; k < scan.pairs.size(); ++k) {
    const PairStatistics& pair = scan.pairs[k];
    rows.push_back({pair.left_angle, pair.right_angle, static_cast<std::int64_t>(pair.windows),
                    static_cast<std::int64_t>(pair.accepted), static_cast<std::int64_t>(pair.points),
                    pair.median_sigma_px, pair.median_sigma});
    if (scan.refinement) {
      rows.back().insert(rows.back().end(), {scan.refinement->angle[k], scan.refinement->shift[k]});
    }
  }
  WriteCsv(path, columns, rows);
}

void SetScanMetrics(const TurntableScan& scan, MetricTable* metrics) {
  std::int64_t windows = 0, accepted = 0;
  for (const PairStatistics& pair : scan.pairs) {
    windows += static_cast<std::int64_t>(pair.windows);
    accepted += static_cast<std::int64_t>(pair.accepted);
  }
  const auto count = [&](const char* name, std::size_t value) {
    metrics->Set(name, static_cast<std::int64_t>(value));
  };
  count("pairs", scan.pairs.size());
  if (!scan.pairs.empty()) {
    metrics->Set("phi_degrees",
                 std::abs(std::remainder(scan.pairs[0].left_angle - scan.pairs[0].right_angle, 360)));
  }
  metrics->Set("windows", windows);
  metrics->Set("accepted", accepted);
  metrics->Set("accepted_percent",
               windows > 0 ? 100 * static_cast<double>(accepted) / static_cast<double>(windows) : 0.0);
  count("view_points", scan.cloud.points_in);
  count("cloud_points", scan.cloud.points.size());
  metrics->Set("cloud_spacing", scan.cloud.spacing);
  metrics->Set("cloud_thickness", scan.cloud.thickness);
  metrics->Set("cloud_relative_thickness", scan.cloud.relative_thickness);
  count("cloud_isolated", scan.cloud.isolated);
  count("cloud_contradicted", scan.cloud.contradicted);
  metrics->Set("overlap_rms", scan.overlap.rms);
  metrics->Set("overlap_normalised", scan.overlap.normalised);
  if (scan.refinement) {
    metrics->Set("overlap_rms_before", scan.refinement->before.rms);
    metrics->Set("overlap_normalised_before", scan.refinement->before.normalised);
  }
}

// cloud_truth_rmse, cloud_truth_max: of the cloud's points to the true object's faces.
void SetCloudTruth(const std::vector<Eigen::Vector3d>& points, const SurfaceMesh& truth, int threads,
                   MetricTable* metrics) {
  const MeshDistance distance(truth);
  std::vector<double> distances(points.size());
  ParallelFor(points.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) distances[k] = distance(points[k]);
  });
  double squares = 0, max = 0;
  for (const double d : distances) {
    squares += d * d;
    max = std::max(max, d);
  }
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const Eigen::Vector3d& vertex : truth.vertices) {
    bottom = std::min(bottom, vertex.z());
    top = std::max(top, vertex.z());
  }
  const double rmse = std::sqrt(squares / static_cast<double>(points.size()));
  metrics->Set("cloud_truth_rmse", rmse);
  metrics->Set("cloud_truth_max", max);
  metrics->Set("cloud_truth_rmse_percent_of_height", 100 * rmse / (top - bottom));
}

ColouredCloud CloudOf(const MergedCloud& merged) {
  ColouredCloud cloud;
  for (const MergedPoint& point : merged.points) {
    cloud.points.push_back(point.position);
    cloud.normals.push_back(point.normal);
    cloud.standard_deviation.push_back(point.sigma);
    cloud.colours.push_back(point.colour);
  }
  return cloud;
}

void FitSurfaceOf(const RunInput& input, std::span<const TangentPlane> silhouettes, const Options& problem,
                  const Solver& solver, const Budget& budget, const RunContext& context,
                  FitOutcome* outcome) {
  TurnedSurfaceFit fit =
      FitTurnedSurface(outcome->cloud->points, silhouettes, SurfaceOptions(problem), solver, budget, context);
  SetSurfaceFit(fit.fit, outcome);
  SetUncertainty(fit.fit.uncertainty, fit.to_disk, outcome);
  outcome->surface = std::move(fit.surface);
  SetTruth(input, context.threads, outcome);
  SetVolumes(input, outcome);
}

FitOutcome Run(const RunInput& run_input, const Options& problem, const Solver& solver, const Budget& budget,
               const RunContext& context) {
  const TurntableInput& input = *run_input.turntable;
  FitOutcome outcome;
  StageClock clock;
  if (context.progress) context.progress("calibration");
  const TurntableCalibration calibration = CalibrateTurntable(input, problem, context.threads, &outcome);
  clock.End("calibration");
  outcome.stages = clock.stages();
  if (input.views.empty()) return outcome;

  TurntableScanOptions options = ScanOptionsFrom(problem);
  const SolverType& window_solver_type = FindSolverType("lm");  // the config's own solver fits the surface
  const auto window_solver = window_solver_type.create(Options(window_solver_type.options));
  options.match_solver = {.solver = window_solver.get(), .budget = {}, .seed = context.seed};
  const auto tell = [&](std::size_t done, std::size_t of) {
    if (context.progress) context.progress("pair " + std::to_string(done) + " of " + std::to_string(of));
  };
  const std::string& list = run_input.description;
  const auto scan = NameErrors(list, [&] {
    return std::make_shared<const TurntableScan>(
        ScanTurntable(input.views, calibration.rig, options, context.threads, tell));
  });
  outcome.stages.insert(outcome.stages.end(), scan->stages.begin(), scan->stages.end());
  outcome.warnings.insert(outcome.warnings.end(), scan->warnings.begin(), scan->warnings.end());
  SetScanMetrics(*scan, &outcome.metrics);
  outcome.files.push_back({"views.csv", [scan](const auto& path) { WritePairs(path, *scan); }});
  outcome.cloud = PointCloud{scan->cloud.Positions()};
  AddCloudFile(CloudOf(scan->cloud), &outcome);
  if (input.truth_mesh) {
    SetCloudTruth(outcome.cloud->points, *input.truth_mesh, context.threads, &outcome.metrics);
  }
  if (problem.Flag("fit_surface")) {
    if (context.progress) context.progress("surface");
    NameErrors(list, [&] {
      FitSurfaceOf(run_input, scan->silhouettes, problem, solver, budget, context, &outcome);
    });
  }
  return outcome;
}

}  // namespace

FitType TurntableFitType() {
  return {.name = "turntable",
          .help = "Photographs of an object on a turning disk to a cloud and a closed surface",
          .options = Specs(),
          .solver_defaults =
              [](const Options& problem, const std::string& solver) {
                return SurfaceFitSolverDefaults(solver, SurfaceOptions(problem));
              },
          .check = Check,
          .check_input = CheckInput,
          .run = Run,
          .input = InputKind::kTurntable};
}

}  // namespace frond
