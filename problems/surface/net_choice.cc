// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/net_choice.h"

#include <algorithm>

#include "problems/surface/sheet_stages.h"

namespace frond {
namespace {

double SquaredDistances(const std::vector<Eigen::Vector3d>& points, const NurbsSurface& surface,
                        int threads) {
  double sum = 0;
  for (const auto& offset : MeasureDistances(points, surface, threads).offsets) sum += offset.squaredNorm();
  return sum;
}

}  // namespace

NetChoice ChooseNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                    const SheetFitOptions& options, const ScanResolution& scan, const Solver& solver,
                    const Budget& budget, const SolveContext& context) {
  constexpr int kSizes[] = {5, 7, 10, 14, 20, 28};
  constexpr std::size_t kHoldOut = 5;
  constexpr double kTolerance = 1.02;
  std::vector<Eigen::Vector3d> held_out, training;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (i % kHoldOut == 0 ? held_out : training).push_back(points[i]);
  }
  NetChoice choice{{0, 0}, {}};
  std::vector<std::pair<int, double>> errors;
  Budget left = budget;
  for (const int size : kSizes) {
    if (size <= std::max(options.degree[0], options.degree[1])) continue;
    const bool too_large = static_cast<std::size_t>(3 * size * size) > training.size();
    const bool spent = left.max_evaluations < 1 || left.max_seconds <= 0;
    if (!errors.empty() && (too_large || spent)) break;
    SheetStages trial(options, {size, size}, scan, solver, left, context);
    const NurbsSurface surface = trial.Fit(&training, start, [](const PointDistances&) { return false; });
    errors.emplace_back(size, SquaredDistances(held_out, surface, context.threads));
    left.max_evaluations -= trial.report().evaluations;
    left.max_seconds -= trial.report().seconds;
    choice.report.evaluations += trial.report().evaluations;
    choice.report.residual_evaluations += trial.report().residual_evaluations;
    choice.report.jacobian_evaluations += trial.report().jacobian_evaluations;
    choice.report.seconds += trial.report().seconds;
  }
  const auto least = std::min_element(errors.begin(), errors.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto chosen = std::find_if(errors.begin(), errors.end(), [&](const auto& error) {
    return error.second <= kTolerance * kTolerance * least->second;
  });
  choice.net = {chosen->first, chosen->first};
  return choice;
}

}  // namespace frond
