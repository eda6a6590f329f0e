// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/sheet_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/errors.h"
#include "models/kd_tree.h"
#include "models/knot_vector.h"
#include "problems/surface/boundary_ring.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/local_noise.h"
#include "problems/surface/outliers.h"
#include "problems/surface/sheet_start.h"
#include "problems/surface/spatial_order.h"
#include "solvers/robust_loss.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kRingRadius = 5;            // in point spacings: circumradius of the triangles kept
constexpr std::size_t kRingPoints = 100000;  // larger clouds are thinned for the ring
constexpr double kStartFairness = 1e-7;
constexpr double kReferenceSize = 70;  // the data's diagonal that lengths in mm were tuned at (MATH.md §1)

// Every k-th of points in spatial order, so that about `wanted` remain: an even thinning.
template <typename T>
std::vector<T> Thinned(const std::vector<T>& all, std::size_t wanted) {
  const std::size_t stride = std::max<std::size_t>(1, all.size() / std::max<std::size_t>(wanted, 1));
  std::vector<T> some;
  some.reserve(all.size() / stride + 1);
  for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

// The cloud's boundary polygon seen along z.
Points RingInFrame(const Points& points, double spacing) {
  const Points some = Thinned(points, kRingPoints);
  std::vector<Eigen::Vector2d> plane;
  plane.reserve(some.size());
  for (const auto& point : some) plane.emplace_back(point.head<2>());
  const double thinning = std::sqrt(static_cast<double>(points.size()) / static_cast<double>(some.size()));
  Points ring;
  for (const auto i : BoundaryRing(plane, kRingRadius * spacing * thinning)) ring.push_back(some[i]);
  return ring;
}

// The boundary loop of the feet in (u, v), scaled to lengths so that curled sheets keep their proportions.
TrimLoop TrimByFeet(const std::vector<Eigen::Vector2d>& feet, const NurbsSurface& surface, double spacing) {
  const std::vector<Eigen::Vector2d> some = Thinned(feet, kRingPoints);
  const SurfaceCells cells(surface);
  double length_u = 0, length_v = 0;
  const std::vector<Eigen::Vector2d> few = Thinned(some, 1000);
  for (const auto& uv : few) {
    const SurfaceCells::Jet1 jet = cells.Evaluate1(uv[0], uv[1]);
    length_u += jet.du.norm() / static_cast<double>(few.size());
    length_v += jet.dv.norm() / static_cast<double>(few.size());
  }
  std::vector<Eigen::Vector2d> plane;
  plane.reserve(some.size());
  for (const auto& uv : some) plane.emplace_back(uv[0] * length_u, uv[1] * length_v);
  const double thinning = std::sqrt(static_cast<double>(feet.size()) / static_cast<double>(some.size()));
  TrimLoop loop;
  for (const auto i : BoundaryRing(plane, kRingRadius * spacing * thinning)) loop.push_back(some[i]);
  return loop;
}

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

// The sum of two stages' reports; objectives are brought to the later one's number of points.
void Append(const SolverReport& stage, double objective_scale, SolverReport* total) {
  for (TracePoint& point : total->trace) point.best_objective *= objective_scale;
  for (TracePoint point : stage.trace) {
    point.evaluations += total->evaluations;
    point.seconds += total->seconds;
    total->trace.push_back(point);
  }
  total->objective = stage.objective;
  total->termination = stage.termination;
  total->message = stage.message;
  total->evaluations += stage.evaluations;
  total->residual_evaluations += stage.residual_evaluations;
  total->jacobian_evaluations += stage.jacobian_evaluations;
  total->iterations += stage.iterations;
  total->seconds += stage.seconds;
}

double RobustDeviation(const std::vector<double>& signed_distances) {
  std::vector<double> distances;
  for (const double d : Thinned(signed_distances, 10000)) distances.push_back(std::abs(d));
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 1.4826 * *middle;
}

// One fit of one net to points in spatial order.
class SheetFitter {
 public:
  SheetFitter(const SheetFitOptions& options, std::array<int, 2> net, const ScanResolution& scan,
              const Solver& solver, const Budget& budget, const SolveContext& context)
      : options_(options),
        net_(net),
        scan_(scan),
        margin_(MarginFor(options, options.control_points)),
        solver_(solver),
        budget_(budget),
        context_(context) {}

  MarginMode margin() const { return margin_; }
  const SolverReport& report() const { return report_; }

  // `remove_outliers` is told the distances of all points before the last stage; it takes the outliers out of
  // `points` itself and says whether there were any.
  NurbsSurface Fit(Points* points, const std::optional<NurbsSurface>& start,
                   const std::function<bool(const PointDistances&)>& remove_outliers) {
    Prepare(*points);
    const std::vector<Stage> stages = Schedule(points->size(), static_cast<std::size_t>(options_.subset),
                                               options_.fairness.value_or(Fairness(points->size())));
    const Points first = Thinned(*points, stages[0].points);
    std::size_t last_points = first.size();
    std::optional<NurbsSurface> best, reference;
    double best_objective = 0;
    for (const NurbsSurface& candidate : Starts(*points, start)) {
      NurbsSurface fitted = RunStage(first, candidate, candidate, stages[0].fairness, {}, last_points);
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
      surface = RunStage(used, surface, *reference, stages[k].fairness, std::move(feet), last_points);
      last_points = used.size();
    }
    return surface;
  }

 private:
  // λ = 1e-10 suits 40,000 points with σ = 0.05 mm on 70 mm (MATH.md §1). As in any smoothing spline the
  // weight λN of the energy goes with σ²: fewer and noisier points want more, or the surface threads through
  // the noise.
  double Fairness(std::size_t points) const {
    const double least = margin_ == MarginMode::kConforming ? 1e-8 : 1e-10;
    const double noise = scan_.noise / (0.05 * length_scale_);
    return std::clamp(1e-10 * noise * noise * 40000 / static_cast<double>(points), least, 1e-4);
  }

  void Prepare(const Points& points) {
    Eigen::AlignedBox3d box;
    for (const auto& point : points) box.extend(point);
    length_scale_ = box.diagonal().norm() / kReferenceSize;
    if (margin_ == MarginMode::kConforming) {
      ring_ = RingInFrame(points, scan_.spacing);
      if (ring_.size() < 8) {
        throw FitError("the cloud has no clear boundary to conform to; use fit.margin: trim or none");
      }
      if (options_.tie_tip) {
        std::vector<int> tip;
        for (int i = 0; i < net_[0]; ++i) tip.push_back(i * net_[1] + net_[1] - 1);
        tied_ = {tip};
      }
    }
  }

  // The given start in the wanted net, and, unless it is to stand alone, one from the cloud itself. The first
  // stage runs from each; the better goes on.
  std::vector<NurbsSurface> Starts(const Points& points, const std::optional<NurbsSurface>& start) const {
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
    const std::vector<Eigen::Vector2d> parameters =
        margin_ == MarginMode::kConforming
            ? OutlineParameters(some, ring_)
            : RectangleParameters(some, points, margin_ == MarginMode::kTrim ? options_.domain_margin : 0);
    starts.push_back(FitAtParameters(some, parameters, Basis(0), Basis(1), kStartFairness));
    return starts;
  }

  BSplineBasis Basis(std::size_t direction) const {
    return UniformBasis(options_.degree[direction], net_[direction]);
  }

  NurbsSurface RunStage(const Points& points, const NurbsSurface& start, const NurbsSurface& reference,
                        double fairness, std::vector<Eigen::Vector2d> feet, std::size_t last_points) {
    DistanceFitOptions fit;
    fit.unknowns = options_.unknowns;
    fit.derivatives = options_.derivatives;
    fit.fairness = fairness;
    fit.length_scale = length_scale_;
    fit.hinge = options_.hinge;
    fit.hinge_limit = options_.hinge_limit;
    fit.tied = tied_;
    if (margin_ == MarginMode::kConforming) {
      fit.margin = MarginOptions{.ring = ring_, .weight = options_.margin_weight};
      if (options_.tie_tip) {
        fit.margin->tip = *std::max_element(ring_.begin(), ring_.end(),
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
      double squared = 0;
      const std::vector<double> distances = MeasureDistances(points, start, context_.threads).signed_distance;
      for (const double d : distances) squared += d * d;
      fit.peak_emphasis = options_.peak_emphasis;
      fit.peak_scale = std::sqrt(squared / static_cast<double>(points.size())) + 1e-9 * length_scale_;
    }
    const SurfaceDistanceFit problem(points, start, reference, std::move(fit), context_.threads,
                                     std::move(feet));
    Budget left = budget_;
    left.max_evaluations = std::max<std::int64_t>(0, left.max_evaluations - report_.evaluations);
    left.max_seconds = std::max(0.0, left.max_seconds - report_.seconds);
    const SolverReport stage = solver_.Solve(problem, left, context_);
    if (stage.termination == Termination::kFailed) throw FitError("the solver failed: " + stage.message);
    Append(stage,
           last_points == 0 ? 1 : static_cast<double>(points.size()) / static_cast<double>(last_points),
           &report_);
    return problem.SurfaceAt(stage.x);
  }

  const SheetFitOptions& options_;
  std::array<int, 2> net_;
  const ScanResolution& scan_;
  MarginMode margin_;
  const Solver& solver_;
  const Budget& budget_;
  const SolveContext& context_;
  double length_scale_ = 1;
  Points ring_;
  std::vector<std::vector<int>> tied_;
  SolverReport report_;
};

// The smallest net within 2 % of the least held-out error (MATH.md §1, "Automatic net").
std::array<int, 2> ChooseNet(const Points& points, const std::optional<NurbsSurface>& start,
                             const SheetFitOptions& options, const ScanResolution& scan, const Solver& solver,
                             const SolveContext& context) {
  constexpr int kSizes[] = {5, 7, 10, 14, 20, 28};
  constexpr std::size_t kHoldOut = 5;  // every fifth point in spatial order
  Points held_out, training;
  for (std::size_t i = 0; i < points.size(); ++i)
    (i % kHoldOut == 0 ? held_out : training).push_back(points[i]);
  std::vector<std::pair<int, double>> errors;
  for (const int size : kSizes) {
    if (size <= std::max(options.degree[0], options.degree[1])) continue;
    if (static_cast<std::size_t>(3 * size * size) > training.size() && !errors.empty()) break;
    SheetFitOptions trial = options;
    trial.margin = MarginFor(options, {0, 0});
    const Budget unlimited;
    SheetFitter fitter(trial, {size, size}, scan, solver, unlimited, context);
    Points used = training;
    const NurbsSurface surface = fitter.Fit(&used, start, [](const PointDistances&) { return false; });
    double squared = 0;
    for (const double d : MeasureDistances(held_out, surface, context.threads).signed_distance)
      squared += d * d;
    errors.emplace_back(size, squared);
  }
  double least = errors.front().second;
  for (const auto& [size, squared] : errors) least = std::min(least, squared);
  for (const auto& [size, squared] : errors) {
    if (squared <= 1.02 * 1.02 * least) return {size, size};
  }
  return {errors.front().first, errors.front().first};
}

void CheckInput(const Points& points, std::array<int, 2> net) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const Eigen::Vector3d size = points.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.sizes());
  if (points.size() < 4 || !(size.minCoeff() >= 0) || size.y() <= 1e-9 * size.x()) {
    throw InputError("the " + std::to_string(points.size()) +
                     " usable points have no extent in two directions; a surface needs an area");
  }
  if (static_cast<std::size_t>(net[0] * net[1]) > points.size()) {
    const int most = static_cast<int>(std::sqrt(static_cast<double>(points.size())));
    throw InputError(std::to_string(points.size()) + " usable points cannot hold " + std::to_string(net[0]) +
                     " x " + std::to_string(net[1]) +
                     " control points; set surface.control_points to at most " + std::to_string(most) +
                     " x " + std::to_string(most));
  }
}

}  // namespace

SheetFit FitSheet(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                  const std::optional<NurbsSurface>& start, const SheetFitOptions& options,
                  const Solver& solver, const Budget& budget, const SolveContext& context) {
  StageClock clock;
  const std::vector<std::uint32_t> order = SpatialOrder(points);
  Points sorted;
  sorted.reserve(points.size());
  for (const auto i : order) sorted.push_back(points[i]);
  const bool automatic = options.control_points[0] == 0;
  const int least = std::max({options.degree[0], options.degree[1], 4}) + 1;
  CheckInput(sorted, automatic ? std::array<int, 2>{least, least} : options.control_points);
  const KdTree tree(sorted);
  ScanResolution scan{.spacing = PointSpacing(sorted, tree)};
  std::vector<std::uint8_t> outlier(sorted.size(), 0);
  if (options.outlier_threshold > 0 && !stray.empty()) {
    for (std::size_t i = 0; i < sorted.size(); ++i) outlier[i] = stray[order[i]];
  }
  scan.noise = LocalNoise(sorted, outlier, tree);
  Points used;
  std::vector<std::uint32_t> used_index;
  const auto keep_inliers = [&] {
    used.clear();
    used_index.clear();
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      if (outlier[i]) continue;
      used.push_back(sorted[i]);
      used_index.push_back(static_cast<std::uint32_t>(i));
    }
  };
  keep_inliers();
  clock.End("points");
  const std::array<int, 2> net =
      automatic ? ChooseNet(used, start, options, scan, solver, context) : options.control_points;
  CheckInput(used, net);
  if (automatic) clock.End("choose_net");

  SheetFitter fitter(options, net, scan, solver, budget, context);
  const auto mark_outliers = [&](const std::vector<Eigen::Vector3d>& offsets_of_used) {
    Points all(sorted.size(), Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < used.size(); ++k) all[used_index[k]] = offsets_of_used[k];
    const std::vector<std::uint8_t> found = OutlyingPoints(sorted, all, tree, options.outlier_threshold);
    bool any = false;
    for (const auto i : used_index) {
      if (!found[i]) continue;
      outlier[i] = 1;
      any = true;
    }
    return any;
  };
  const auto remove_outliers = [&](const PointDistances& distances) {
    if (options.outlier_threshold <= 0 || !mark_outliers(distances.offsets)) return false;
    keep_inliers();
    return true;
  };
  NurbsSurface surface = fitter.Fit(&used, start, remove_outliers);
  clock.End("fit");

  PointDistances distances = MeasureDistances(sorted, surface, context.threads);
  if (options.outlier_threshold > 0) {
    Points of_used;
    for (const auto i : used_index) of_used.push_back(distances.offsets[i]);
    mark_outliers(of_used);
  }
  clock.End("distances");
  SheetFit result{.surface = {std::move(surface), {}},
                  .control_points = net,
                  .margin = fitter.margin(),
                  .outlier = {},
                  .distances = {},
                  .quality = {},
                  .report = fitter.report(),
                  .stages = {},
                  .warnings = {}};
  if (result.margin == MarginMode::kTrim) {
    std::vector<Eigen::Vector2d> feet;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      if (!outlier[i]) feet.push_back(distances.feet[i]);
    }
    TrimLoop loop = TrimByFeet(feet, result.surface.surface, scan.spacing);
    if (loop.size() >= 3) result.surface.trim.push_back(std::move(loop));
    if (result.surface.trim.empty()) {
      result.warnings.emplace_back("the feet have no clear boundary: the surface is left untrimmed");
    }
    clock.End("trim");
  }
  result.quality = JudgeSurface(sorted, outlier, distances, result.surface, scan, tree, context.threads);
  clock.End("quality");

  result.outlier.resize(sorted.size());
  result.distances.signed_distance.resize(sorted.size());
  result.distances.feet.resize(sorted.size());
  result.distances.offsets.resize(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {  // back to the input's order
    result.outlier[order[i]] = outlier[i];
    result.distances.signed_distance[order[i]] = distances.signed_distance[i];
    result.distances.feet[order[i]] = distances.feet[i];
    result.distances.offsets[order[i]] = distances.offsets[i];
  }
  result.stages = clock.stages();
  return result;
}

SheetJudgement JudgeSheet(std::span<const Eigen::Vector3d> points, const TrimmedSurface& surface,
                          int threads) {
  SheetJudgement judgement;
  const KdTree tree(points);
  ScanResolution scan{.spacing = PointSpacing(points, tree)};
  judgement.outlier = StrayPoints(points);
  scan.noise = LocalNoise(points, judgement.outlier, tree);
  judgement.distances = MeasureDistances(points, surface.surface, threads);
  judgement.quality =
      JudgeSurface(points, judgement.outlier, judgement.distances, surface, scan, tree, threads);
  return judgement;
}

}  // namespace frond
