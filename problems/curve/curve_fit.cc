// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "models/curve_foot_point.h"
#include "models/nurbs_operations.h"
#include "problems/curve/curve_knots.h"
#include "problems/curve/curve_parameters.h"
#include "problems/curve/curve_stages.h"
#include "solvers/report_sum.h"

namespace frond {
namespace {

constexpr std::size_t kPointChunk = 256;
constexpr std::size_t kHoldOut = 5, kHeldOut = 2;  // of every five points in order, the third

using Points = std::vector<Eigen::Vector3d>;

// `closed`: none where it is still to be found.
void CheckInput(std::span<const Eigen::Vector3d> points, const CurveFitOptions& options,
                std::optional<bool> closed) {
  const auto least = static_cast<std::size_t>(std::max(options.control_points, options.degree + 1));
  if (points.size() < least) {
    throw InputError(
        "there are " + std::to_string(points.size()) + " points, fewer than the " + std::to_string(least) +
        " control points" + (closed.value_or(false) ? " of the closed curve" : "") +
        "; take more points, or fewer control points ('curve.control_points') or a lower degree");
  }
  if (options.control_points == 0 || !closed) return;
  const std::string fault = KnotCountFault(options, options.control_points, *closed);
  if (!fault.empty()) throw InputError(fault);
}

Eigen::Vector3d Mean(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

double RootMeanSquareDistance(const Points& points, const NurbsCurve& curve) {
  const CurveSpans spans(curve);
  const CurveFootSearch search(spans);
  double sum = 0;
  for (const Eigen::Vector3d& point : points) sum += search.Find(point).squared_distance;
  return std::sqrt(sum / static_cast<double>(points.size()));
}

// The least number from `size` that makes a knot vector; one with the double knots that conics need where the
// next has them.
int CountFrom(int size, const CurveFitOptions& options, bool closed) {
  int count = std::max(size, options.degree + 1);
  while (!KnotCountFault(options, count, closed).empty()) ++count;
  const bool next_is_conic =
      KnotMultiplicity(options, count + 1, closed) > KnotMultiplicity(options, count, closed);
  return count > 4 && next_is_conic ? count + 1 : count;
}

struct Choice {
  int control_points = 0;
  SolverReport report;  // what all trials took together
};

// The fewest control points within 2 % of the least RMS distance of held-out points; errors below 1e-9 of the
// extent count as that.
Choice ChooseControlPoints(const Points& points, const LocatedPoints& located, CurveFitOptions options,
                           double extent, const Solver& solver, const Budget& budget,
                           const SolveContext& context) {
  constexpr int kSizes[] = {3, 4, 5, 6, 8, 10, 14, 20, 28, 40, 56, 80, 112};
  constexpr double kTolerance = 1.02, kExact = 1e-9;
  Points training, held_out;
  std::vector<double> parameters;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kHoldOut == kHeldOut && i + 1 < points.size()) {
      held_out.push_back(points[i]);
    } else {
      training.push_back(points[i]);
      parameters.push_back(located.parameters[i]);
    }
  }
  Choice choice;
  if (held_out.empty()) throw InputError("too few points to choose the number of control points; give it");
  std::vector<std::pair<int, double>> errors;
  Budget left = budget;
  for (const int wanted : kSizes) {
    const int size = CountFrom(wanted, options, located.closed);
    if (!errors.empty() && size <= errors.back().first) continue;
    const bool spent = left.max_evaluations < 1 || left.max_seconds <= 0;
    const bool too_many = static_cast<std::size_t>(2 * size) > training.size();
    if (!errors.empty() && (spent || too_many || errors.back().second <= kExact * extent)) break;
    if (static_cast<std::size_t>(size) > training.size()) break;
    options.control_points = size;
    CurveStages trial(options, solver, left, context);
    const BSplineBasis basis = PlaceKnots(training, parameters, located.closed, options);
    const NurbsCurve curve = trial.Fit(training, parameters, basis);
    errors.emplace_back(size, std::max(RootMeanSquareDistance(held_out, curve), kExact * extent));
    left.max_evaluations -= trial.report().evaluations;
    left.max_seconds -= trial.report().seconds;
    AddCost(trial.report(), &choice.report);
  }
  if (errors.empty()) throw InputError("there are too few points for any number of control points");
  const auto least = std::min_element(errors.begin(), errors.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  choice.control_points = std::find_if(errors.begin(), errors.end(), [&](const auto& error) {
                            return error.second <= kTolerance * least->second;
                          })->first;
  return choice;
}

}  // namespace

CurveFit FitCurve(std::span<const Eigen::Vector3d> points, const CurveFitOptions& options_in,
                  const Solver& solver, const Budget& budget, const SolveContext& context) {
  StageClock clock;
  CurveFitOptions options = options_in;
  CheckInput(points, options, options.closed);
  const Eigen::Vector3d centre = Mean(points);
  Points local;
  double extent = 0;
  for (const Eigen::Vector3d& point : points) {
    local.emplace_back(point - centre);
    extent = std::max(extent, (point - points.front()).norm());
  }
  if (!(extent > 0)) throw InputError("all points coincide: no curve goes through one point");
  const LocatedPoints located = LocatePoints(local, options);
  CheckInput(points, options, located.closed);
  Points ordered;
  for (const std::size_t i : located.order) ordered.push_back(local[i]);
  clock.End("parameters");
  Budget left = budget;
  SolverReport trials;
  if (options.control_points == 0) {
    const Choice choice = ChooseControlPoints(ordered, located, options, extent, solver, budget, context);
    options.control_points = choice.control_points;
    trials = choice.report;
    left.max_evaluations = std::max<std::int64_t>(1, left.max_evaluations - trials.evaluations);
    left.max_seconds -= trials.seconds;
    clock.End("control_points");
  }
  const BSplineBasis basis = PlaceKnots(ordered, located.parameters, located.closed, options);
  CurveStages stages(options, solver, left, context);
  const NurbsCurve curve = stages.Fit(ordered, located.parameters, basis);
  clock.End("fit");

  CurveFit fit{.curve = Transformed(curve, Eigen::Affine3d(Eigen::Translation3d(centre))),
               .location_parameters = std::vector<double>(points.size()),
               .parameters = std::vector<double>(points.size()),
               .distances = std::vector<double>(points.size()),
               .order = located.order,
               .report = stages.report(),
               .stages = {},
               .warnings = {}};
  AddCost(trials, &fit.report);
  const CurveSpans spans(curve);
  const CurveFootSearch search(spans);
  ParallelFor(ordered.size(), kPointChunk, context.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const CurveFoot foot = search.FindFrom(ordered[k], stages.parameters()[k]);
      const std::size_t i = located.order[k];
      fit.location_parameters[i] = basis.IntoDomain(located.parameters[k]);
      fit.parameters[i] = foot.t;
      fit.distances[i] = std::sqrt(foot.squared_distance);
    }
  });
  clock.End("distances");
  fit.stages = clock.stages();
  return fit;
}

}  // namespace frond
