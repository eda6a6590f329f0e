// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/surface_fit_stages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/errors.h"
#include "base/median.h"
#include "models/knot_vector.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/ma_fit.h"
#include "problems/surface/parametric_fit.h"
#include "problems/surface/sheet_boundary.h"
#include "problems/surface/sheet_start.h"
#include "problems/surface/spatial_order.h"
#include "solvers/report_sum.h"
#include "solvers/robust_loss.h"

namespace frond {
namespace {

constexpr double kStartFairness = 1e-7;
constexpr double kFoundRims = 0.05;    // of the margin's weight
constexpr double kReferenceSize = 70;  // the data's diagonal that lengths in mm were tuned at (MATH.md §1)

struct Stage {
  std::size_t points;  // wanted; the whole cloud if above its size
  double fairness;
};

std::vector<Stage> Schedule(std::size_t points, std::size_t subset, double fairness) {
  std::vector<Stage> stages = {{subset, std::max(fairness, 1e-8)}};
  if (fairness < 1e-8) stages.push_back({subset, std::max(fairness, 1e-9)});
  if (points > 8 * subset) stages.push_back({4 * subset, fairness});
  stages.push_back({points, fairness});
  return stages;
}

// Objectives so far are brought to the later stage's number of points.
void Append(const SolverReport& stage, double objective_scale, SolverReport* total) {
  for (TracePoint& point : total->trace) point.best_objective *= objective_scale;
  AppendStage(stage, total);
}

double RobustDeviation(const std::vector<double>& signed_distances) {
  std::vector<double> distances;
  for (const double d : Thinned(signed_distances, 10000)) distances.push_back(std::abs(d));
  return 1.4826 * Median(std::move(distances));
}

double RootMeanSquare(const std::vector<double>& values) {
  double squared = 0;
  for (const double value : values) squared += value * value;
  return std::sqrt(squared / static_cast<double>(values.size()));
}

}  // namespace

SurfaceFitStages::SurfaceFitStages(const SurfaceFitOptions& options, std::array<int, 2> net,
                                   const ScanResolution& scan, const Solver& solver, const Budget& budget,
                                   const SolveContext& context)
    : options_(options),
      net_(net),
      scan_(scan),
      margin_(MarginFor(options, options.control_points)),
      solver_(solver),
      budget_(budget),
      context_(context) {}

NurbsSurface SurfaceFitStages::Fit(const Points* points, const std::optional<NurbsSurface>& start,
                                   const std::function<bool(const PointDistances&)>& remove_outliers) {
  Prepare(*points, start);
  return options_.method == SurfaceMethod::kDistance ? FitDistances(points, start, remove_outliers)
                                                     : FitParametric(points, remove_outliers);
}

NurbsSurface SurfaceFitStages::FitDistances(
    const Points* points, const std::optional<NurbsSurface>& start,
    const std::function<bool(const PointDistances&)>& remove_outliers) {
  if (std::optional<NurbsSurface> exact = FitExactly(*points, start)) return *std::move(exact);
  const std::vector<Stage> stages = Schedule(points->size(), static_cast<std::size_t>(options_.subset),
                                             options_.fairness.value_or(Fairness(points->size())));
  const Points first = Thinned(*points, stages[0].points);
  std::size_t last_points = first.size();
  std::optional<NurbsSurface> best, reference;
  double best_objective = 0;
  for (const NurbsSurface& candidate : Starts(*points, start)) {
    NurbsSurface fitted = RunStage(first, candidate, candidate,
                                   StageOptions(first, candidate, stages[0].fairness), {}, last_points);
    if (best && !(report_.objective < best_objective)) continue;
    best_objective = report_.objective;
    best = std::move(fitted);
    reference = candidate;
  }
  NurbsSurface surface = *best;
  for (std::size_t k = 1; k < stages.size(); ++k) {
    const bool last = k + 1 == stages.size();
    std::vector<Eigen::Vector2d> feet;
    if (last) {
      PointDistances distances = MeasureDistances(*points, surface, context_.threads, 1);
      if (!remove_outliers(distances)) feet = std::move(distances.feet);
    }
    const Points some = last ? Points() : Thinned(*points, stages[k].points);
    const Points& used = last ? *points : some;
    surface = RunStage(used, surface, *reference, StageOptions(used, surface, stages[k].fairness),
                       std::move(feet), last_points);
    last_points = used.size();
  }
  return surface;
}

NurbsSurface SurfaceFitStages::FitParametric(
    const Points* points, const std::function<bool(const PointDistances&)>& remove_outliers) {
  const ParametricFitOptions options{.free_weights = options_.method == SurfaceMethod::kMa,
                                     .fairness = options_.fairness.value_or(Fairness(points->size())),
                                     .repetitions = options_.repetitions,
                                     .poles = PolesOf(options_.topology)};
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for (int pass = 0;; ++pass) {
    ParametricFit fit =
        FitAtFixedParameters(*points, Parameters(*points), Basis(0), Basis(1), options, context_.threads);
    report_.objective = 0.5 * fit.squared_sum;
    report_.iterations += static_cast<int>(fit.history.size());
    report_.termination = Termination::kConverged;
    report_.message = "linear fits at fixed parameters";
    for (const double squared : fit.history) {
      report_.trace.push_back({++report_.evaluations, seconds(), 0.5 * squared});
    }
    report_.seconds = seconds();
    if (fit.history.size() > 1) base_ = std::move(fit.base);
    if (pass > 0 || !remove_outliers(MeasureDistances(*points, fit.surface, context_.threads, 1))) {
      return fit.surface;
    }
  }
}

// λ = 1e-10 suits 40,000 points with σ = 0.05 mm on 70 mm (MATH.md §1). As in any smoothing spline the
// weight λN of the energy goes with σ²: fewer and noisier points want more, or the surface threads through
// the noise.
double SurfaceFitStages::Fairness(std::size_t points) const {
  double least = margin_ == MarginMode::kConforming ? 1e-8 : 1e-10;
  if (options_.topology == SurfaceTopology::kSphere) least = 3e-10;
  if (options_.topology == SurfaceTopology::kTube || options_.topology == SurfaceTopology::kCup) least = 2e-9;
  const double noise = options_.noise_free ? 0 : scan_.noise / (0.05 * length_scale_);
  return std::clamp(1e-10 * noise * noise * 40000 / static_cast<double>(points), least, 1e-4);
}

void SurfaceFitStages::Prepare(const Points& points, const std::optional<NurbsSurface>& start) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  extent_ = {box.min(), box.max()};
  base_ = start;
  length_scale_ = box.diagonal().norm() / kReferenceSize;
  if (options_.topology != SurfaceTopology::kSheet) {
    PrepareRims(points);
  } else if (margin_ == MarginMode::kConforming) {
    rings_ = {BoundaryOfSheet(points, scan_.spacing)};
    if (rings_[0].size() < 8) {
      throw FitError("the cloud has no clear boundary to conform to; use fit.margin: trim or none");
    }
    if (options_.tie_tip) {
      std::vector<int> tip;
      for (int i = 0; i < net_[0]; ++i) tip.push_back(i * net_[1] + net_[1] - 1);
      tied_ = {tip};
    }
  }
}

void SurfaceFitStages::PrepareRims(const Points& points) {
  const SurfaceTopology topology = options_.topology;
  rings_ = options_.rims;
  if (topology == SurfaceTopology::kSphere || !rings_.empty()) return;
  const Points some = Thinned(points, static_cast<std::size_t>(options_.subset));
  const double thinning = std::sqrt(static_cast<double>(points.size()) / static_cast<double>(some.size()));
  const double spacing = scan_.spacing * thinning;
  rings_ = GuessRims(some, topology, spacing);
  rings_ = FindRims(some, topology, rings_, spacing);
  for (const Ring& ring : rings_) {
    if (ring.size() < 8) throw FitError("the cloud has no clear rim; set fit.margin: none, or topology");
  }
}

// The given start in the wanted net, and, unless it is to stand alone, one from the cloud itself. The first
// stage runs from each; the better goes on.
std::vector<NurbsSurface> SurfaceFitStages::Starts(const Points& points,
                                                   const std::optional<NurbsSurface>& start) const {
  std::vector<NurbsSurface> starts;
  const Points some = Thinned(points, static_cast<std::size_t>(options_.subset));
  if (start) {
    const bool same_net = start->count_u() == net_[0] && start->count_v() == net_[1] &&
                          start->u().degree() == options_.degree[0] &&
                          start->v().degree() == options_.degree[1];
    starts.push_back(same_net ? *start
                              : FitAtParameters(some, FootParameters(some, *start, context_.threads),
                                                Basis(0), Basis(1), kStartFairness));
    if (options_.given_start_only) return starts;
  }
  const std::vector<Eigen::Vector2d> parameters = CloudParameters(some);
  if (options_.start_from_ma) {
    starts.push_back(FitRationalAtParameters(some, parameters, Basis(0), Basis(1), kStartFairness));
  } else {
    starts.push_back(
        FitAtParameters(some, parameters, Basis(0), Basis(1), kStartFairness, PolesOf(options_.topology)));
  }
  return starts;
}

std::vector<Eigen::Vector2d> SurfaceFitStages::CloudParameters(
    std::span<const Eigen::Vector3d> points) const {
  const SurfaceTopology topology = options_.topology;
  if (topology != SurfaceTopology::kSheet) {
    const bool sphere = topology == SurfaceTopology::kSphere && options_.base == BaseSurface::kAuto
                            ? IsStarShaped(points)
                            : options_.base == BaseSurface::kSphere;
    if (sphere) return SphericalParameters(points);
    if (options_.base == BaseSurface::kCylinder) return CylinderParameters(points);
    return GeodesicParameters(points, topology, rings_);
  }
  if (margin_ == MarginMode::kConforming) return OutlineParameters(points, rings_[0]);
  return RectangleParameters(points, extent_, margin_ == MarginMode::kTrim ? options_.domain_margin : 0);
}

std::vector<Eigen::Vector2d> SurfaceFitStages::Parameters(std::span<const Eigen::Vector3d> points) const {
  return base_ ? FootParameters(points, *base_, context_.threads) : CloudParameters(points);
}

BSplineBasis SurfaceFitStages::Basis(std::size_t direction) const {
  if (direction == 0 && options_.topology != SurfaceTopology::kSheet) {
    return PeriodicUniformBasis(options_.degree[0], net_[0]);
  }
  return UniformBasis(options_.degree[direction], net_[direction]);
}

DistanceFitOptions SurfaceFitStages::StageOptions(const Points& points, const NurbsSurface& start,
                                                  double fairness) const {
  DistanceFitOptions fit;
  fit.unknowns = options_.unknowns;
  fit.derivatives = options_.derivatives;
  fit.fairness = fairness;
  fit.length_scale = length_scale_;
  fit.hinge = options_.hinge;
  const bool sheet = options_.topology == SurfaceTopology::kSheet;
  fit.hinge_limit = options_.hinge_limit.value_or(sheet ? 0.3 : 0.1);
  fit.tied = tied_;
  fit.poles = PolesOf(options_.topology);
  if (margin_ == MarginMode::kConforming) {
    fit.margin = MarginOptions{.rings = rings_, .weight = options_.margin_weight};
    if (!options_.rims.empty()) {
      fit.margin->outside_weight = 1;
    } else if (!sheet) {  // rims found go in and out by a spacing or two: the points beyond them decide
      fit.margin->weight *= kFoundRims;
    } else if (options_.tie_tip) {
      const Ring& ring = rings_[0];
      fit.margin->tip = *std::max_element(ring.begin(), ring.end(),
                                          [](const auto& a, const auto& b) { return a.x() < b.x(); });
    }
  }
  if (options_.loss != "none") {
    const double deviation =
        RobustDeviation(MeasureDistances(points, start, context_.threads).signed_distance);
    fit.loss =
        MakeRobustLoss(options_.loss, std::max(options_.loss_scale * deviation, 1e-12 * length_scale_));
  }
  if (options_.peak_emphasis > 0 && options_.loss == "none") {
    fit.peak_emphasis = options_.peak_emphasis;
    fit.peak_scale = RootMeanSquare(MeasureDistances(points, start, context_.threads).signed_distance) +
                     1e-9 * length_scale_;
  }
  return fit;
}

NurbsSurface SurfaceFitStages::RunStage(const Points& points, const NurbsSurface& start,
                                        const NurbsSurface& reference, const DistanceFitOptions& options,
                                        std::vector<Eigen::Vector2d> feet, std::size_t last_points) {
  last_options_ = options;
  Budget left = budget_;
  left.max_evaluations -= report_.evaluations;
  left.max_seconds -= report_.seconds;
  if (left.max_evaluations < 1 || left.max_seconds <= 0) {  // the surface stays as it is
    report_.termination =
        left.max_evaluations < 1 ? Termination::kEvaluationBudget : Termination::kTimeBudget;
    return start;
  }
  const SurfaceDistanceFit problem(points, start, reference, options, context_.threads, std::move(feet));
  const SolverReport stage = solver_.Solve(problem, left, context_);
  if (stage.termination == Termination::kFailed) throw FitError("the solver failed: " + stage.message);
  Append(stage, last_points == 0 ? 1 : static_cast<double>(points.size()) / static_cast<double>(last_points),
         &report_);
  return problem.SurfaceAt(stage.x);
}

}  // namespace frond
