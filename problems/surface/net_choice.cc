// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/net_choice.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>

#include "problems/surface/surface_fit_stages.h"
#include "solvers/report_sum.h"

namespace frond {
namespace {

constexpr std::size_t kHoldOut = 5;

}  // namespace

NetTrial TryNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                const SurfaceFitOptions& options, std::array<int, 2> net, const ScanResolution& scan,
                const Solver& solver, const Budget& budget, const SolveContext& context) {
  std::vector<Eigen::Vector3d> held_out, training;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (i % kHoldOut == 0 ? held_out : training).push_back(points[i]);
  }
  SurfaceFitStages stages(options, net, scan, solver, budget, context);
  const NurbsSurface surface = stages.Fit(&training, start, [](const PointDistances&) { return false; });
  double sum = 0;
  for (const auto& offset : MeasureDistances(held_out, surface, context.threads).offsets) {
    sum += offset.squaredNorm();
  }
  return {std::sqrt(sum / static_cast<double>(held_out.size())), stages.report()};
}

NetChoice ChooseNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                    const SurfaceFitOptions& options, const ScanResolution& scan, const Solver& solver,
                    const Budget& budget, const SolveContext& context) {
  constexpr double kGain = 0.99, kTolerance = 1.01;
  std::vector<int> sizes;
  for (const int size : {5, 7, 10, 14, 20, 28}) {
    if (size > std::max(options.degree[0], options.degree[1])) sizes.push_back(size);
  }
  if (sizes.empty()) sizes.push_back(std::max(options.degree[0], options.degree[1]) + 1);
  using Steps = std::array<std::size_t, 2>;  // indices into `sizes`
  const auto net_of = [&](const Steps& steps) {
    return std::array<int, 2>{sizes[steps[0]], sizes[steps[1]]};
  };
  NetChoice choice{{0, 0}, {}};
  std::map<Steps, double> errors;
  Budget left = budget;
  // The held-out RMS of a net; infinite where it is not tried.
  const auto error_of = [&](const Steps& steps) {
    constexpr double kUntried = std::numeric_limits<double>::infinity();
    if (steps[0] >= sizes.size() || steps[1] >= sizes.size()) return kUntried;
    if (const auto known = errors.find(steps); known != errors.end()) return known->second;
    const auto [nu, nv] = net_of(steps);
    const bool too_large = static_cast<std::size_t>(3 * nu * nv) > points.size() * (kHoldOut - 1) / kHoldOut;
    const bool spent = left.max_evaluations < 1 || left.max_seconds <= 0;
    if (!errors.empty() && (too_large || spent)) return kUntried;
    const NetTrial trial = TryNet(points, start, options, {nu, nv}, scan, solver, left, context);
    left.max_evaluations -= trial.report.evaluations;
    left.max_seconds -= trial.report.seconds;
    AddCost(trial.report, &choice.report);
    return errors[steps] = trial.held_out_rmse;
  };
  Steps at = {0, 0};
  double here = error_of(at);
  const auto best_of = [&](std::initializer_list<Steps> beside) {
    return *std::min_element(beside.begin(), beside.end(),
                             [&](const Steps& a, const Steps& b) { return error_of(a) < error_of(b); });
  };
  for (bool moved = true; moved;) {
    Steps next = best_of({{at[0] + 1, at[1]}, {at[0], at[1] + 1}});
    if (!(error_of(next) < kGain * here)) {  // a feature may need two steps to show
      next = best_of({{at[0] + 1, at[1] + 1}, {at[0] + 2, at[1]}, {at[0], at[1] + 2}});
    }
    moved = error_of(next) < kGain * here;
    if (moved) {
      at = next;
      here = error_of(at);
    }
  }
  double least = here;
  for (const auto& [steps, error] : errors) least = std::min(least, error);
  int fewest = std::numeric_limits<int>::max();
  for (const auto& [steps, error] : errors) {
    const auto [nu, nv] = net_of(steps);
    if (error > kTolerance * least || nu * nv >= fewest) continue;
    fewest = nu * nv;
    choice.net = {nu, nv};
  }
  return choice;
}

}  // namespace frond
