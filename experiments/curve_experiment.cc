// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/curve_experiment.h"

#include <algorithm>
#include <cmath>

#include "models/curve_foot_point.h"
#include "problems/curve/curve_errors.h"
#include "problems/curve/curve_fit.h"

namespace frond {
namespace {

void SetErrors(const CurveErrors& errors, const CurveFit& fit, MetricTable* metrics) {
  metrics->Set("rmse", errors.rmse);
  metrics->Set("max", errors.max);
  metrics->Set("mean", errors.mean);
  metrics->Set("p95", errors.p95);
  metrics->Set("perpendicular_total", errors.perpendicular_total);
  metrics->Set("perpendicular_mean", errors.perpendicular_mean);
  metrics->Set("parametric_total", errors.parametric_total);
  metrics->Set("parametric_mean", errors.parametric_mean);
  metrics->Set("relative_mean_percent", 100 * errors.relative_mean);
  metrics->Set("length", errors.length);
  metrics->Set("control_points", std::int64_t{fit.curve.basis().num_distinct_control_points()});
  metrics->Set("degree", std::int64_t{fit.curve.basis().degree()});
  metrics->Set("spans", static_cast<std::int64_t>(fit.curve.basis().spans().size()));
  metrics->Set("closed", fit.closed());
}

void SetTruthErrors(const std::vector<Eigen::Vector3d>& truth, const NurbsCurve& curve,
                    MetricTable* metrics) {
  if (truth.empty()) return;
  const CurveSpans spans(curve);
  const CurveFootSearch search(spans);
  double squared = 0, max = 0;
  for (const Eigen::Vector3d& point : truth) {
    const double distance = search.Find(point).squared_distance;
    squared += distance;
    max = std::max(max, distance);
  }
  metrics->Set("truth_rmse", std::sqrt(squared / static_cast<double>(truth.size())));
  metrics->Set("truth_max", std::sqrt(max));
}

FitOutcome RunCurve(const RunInput& input, const Options& problem, const Solver& solver, const Budget& budget,
                    const SolveContext& context) {
  CurveFit fit = FitCurve(input.cloud.points, CurveFitOptionsFrom(problem), solver, budget, context);
  FitOutcome outcome;
  SetErrors(MeasureCurveErrors(input.cloud.points, fit), fit, &outcome.metrics);
  SetTruthErrors(input.truth, fit.curve, &outcome.metrics);
  outcome.curve = std::move(fit.curve);
  outcome.report = std::move(fit.report);
  outcome.signed_distances = std::move(fit.distances);
  outcome.stages = std::move(fit.stages);
  outcome.warnings = std::move(fit.warnings);
  return outcome;
}

}  // namespace

FitType CurveFitType() {
  return {.name = "curve",
          .help = "An open or closed NURBS curve to points in order or not, by least distances",
          .options = CurveFitSpecs(),
          .solver_defaults = [](const Options&,
                                const std::string& solver) { return CurveFitSolverDefaults(solver); },
          .check = CheckCurveOptions,
          .run = RunCurve,
          .formats = CurveFormats()};
}

}  // namespace frond
