// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_stages.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/errors.h"
#include "base/parallel.h"
#include "problems/curve/parametric_start.h"
#include "solvers/report_sum.h"

namespace frond {
namespace {

constexpr int kMostStages = 6;
constexpr double kExact = 1e-9;           // RMS distance, of the extent
constexpr double kSmoothFairness = 1e-8;  // of the curve whose bending energy is the measure
constexpr double kProgress = 0.7;         // a stage that leaves more of the RMS distance is the last
constexpr std::size_t kPointChunk = 1024;

double RootMeanSquare(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& parameters,
                      const NurbsCurve& curve) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += (curve.Evaluate(parameters[i]) - points[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

double BendingEnergy(const NurbsCurve& curve) {
  const SpanPolynomials spans(curve.basis());
  const std::vector<Eigen::MatrixXd> grams = BendingGram(spans, curve.basis().end() - curve.basis().begin());
  double energy = 0;
  for (int k = 0; k < spans.count(); ++k) {
    const Eigen::MatrixXd& gram = grams[static_cast<std::size_t>(k)];
    Eigen::MatrixXd local(gram.rows(), 3);
    for (Eigen::Index a = 0; a < gram.rows(); ++a) {
      local.row(a) = curve.control_points()[static_cast<std::size_t>(spans.first(k) + a)].transpose();
    }
    energy += (gram * local).cwiseProduct(local).sum();
  }
  return energy;
}

}  // namespace

CurveStages::CurveStages(const CurveFitOptions& options, const Solver& solver, const Budget& budget,
                         const SolveContext& context)
    : options_(options), solver_(solver), budget_(budget), context_(context) {}

NurbsCurve CurveStages::Fit(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& parameters,
                            const BSplineBasis& basis) {
  const bool by_noise = !options_.fairness && options_.distance == CurveDistance::kOrthogonal;
  if (!by_noise || options_.unknowns == CurveUnknowns::kControlPoints) {
    return RunStages(points, parameters, basis, by_noise).curve;
  }
  const Result free = RunStages(points, parameters, basis, false);
  double extent = 0;
  for (const Eigen::Vector3d& point : points) extent = std::max(extent, (point - points.front()).norm());
  if (free.rmse <= kExact * extent) return free.curve;
  const std::vector<double> feet = parameters_;
  const Result smooth = RunStages(points, parameters, basis, true);
  const bool spent = report_.termination == Termination::kEvaluationBudget ||
                     report_.termination == Termination::kTimeBudget;
  if (!spent || smooth.rmse <= free.rmse) return smooth.curve;
  parameters_ = feet;
  return free.curve;
}

CurveStages::Result CurveStages::RunStages(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<double>& parameters, const BSplineBasis& basis,
                                           bool by_noise) {
  parameters_ = parameters;
  const bool free_weights = options_.unknowns != CurveUnknowns::kControlPoints;
  const double fixed = options_.fairness.value_or(0);
  std::vector<NurbsCurve> starts = {FitCurveAtParameters(points, parameters, basis, fixed)};
  if (free_weights) {
    starts.push_back(
        FitCurveAtParameters(points, parameters, basis, fixed, MaWeights(points, parameters, basis)));
  }
  double last = RootMeanSquare(points, parameters, starts[0]);
  const double energy = BendingEnergy(FitCurveAtParameters(points, parameters, basis, kSmoothFairness));
  const auto fairness = [&](double rmse) {
    if (!by_noise || !(energy > 0)) return fixed;
    return rmse * rmse * basis.num_distinct_control_points() / (energy * static_cast<double>(points.size()));
  };
  std::optional<Result> best;
  for (const NurbsCurve& start : starts) {
    Result result = RunStage(points, parameters, start, fairness(last), last * last);
    if (!best || result.objective < best->objective) best = std::move(result);
  }
  FollowFeet(points, best->curve);
  for (int stage = 1; (free_weights || by_noise) && stage < kMostStages; ++stage) {
    if (!(best->rmse < kProgress * last)) break;
    last = best->rmse;
    best = RunStage(points, parameters_, best->curve, fairness(last), last * last);
    FollowFeet(points, best->curve);
  }
  return *best;
}

CurveStages::Result CurveStages::RunStage(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<double>& parameters, const NurbsCurve& start,
                                          double fairness, double ridge) {
  Budget left = budget_;
  left.max_evaluations -= report_.evaluations;
  left.max_seconds -= report_.seconds;
  const CurveDistanceFit problem(points, parameters, start,
                                 {.unknowns = options_.unknowns,
                                  .distance = options_.distance,
                                  .derivatives = options_.derivatives,
                                  .fairness = fairness,
                                  .weight_ridge = ridge});
  if (left.max_evaluations < 1 || left.max_seconds <= 0) {  // the curve stays as it is
    report_.termination =
        left.max_evaluations < 1 ? Termination::kEvaluationBudget : Termination::kTimeBudget;
    return {start, problem.Metrics(problem.StartVector()).at("rmse"),
            std::numeric_limits<double>::infinity()};
  }
  const SolverReport stage = solver_.Solve(problem, left, context_);
  if (stage.termination == Termination::kFailed) throw FitError("the solver failed: " + stage.message);
  AppendStage(stage, &report_);
  report_.x = stage.x;
  return {problem.CurveAt(stage.x), problem.Metrics(stage.x).at("rmse"), stage.objective};
}

void CurveStages::FollowFeet(const std::vector<Eigen::Vector3d>& points, const NurbsCurve& curve) {
  if (options_.distance == CurveDistance::kParametric) return;
  const CurveSpans spans(curve);
  ParallelFor(points.size(), kPointChunk, context_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      parameters_[i] = RefineCurveFoot(spans, points[i], parameters_[i], {}).t;
    }
  });
}

}  // namespace frond
