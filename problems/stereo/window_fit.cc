// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/errors.h"
#include "problems/stereo/window_description.h"
#include "problems/stereo/window_dispatch.h"
#include "problems/stereo/window_pixels.h"
#include "solvers/compressed_cost_function.h"

namespace frond {
namespace {

// Half the sides of the boxes about the start, beside the shifts: slopes of the disparity (px a px), its
// curvatures (px a px²), gain, offset (grey levels), slopes of the gain (a pixel).
constexpr double kSlopeBox = 0.2, kCurvatureBox = 0.02;
constexpr RadiometryValues kRadiometryBox = {0.5, 50, 0.05, 0.05};

// Rounds of choosing the pixels at the warp found, as WindowMatcher does.
constexpr int kMaxRounds = 3;

double WarpBox(WarpKind kind, int j, double shift) {
  if (kind == WarpKind::kAffine) return j % 3 == 0 ? shift : kSlopeBox;
  return j == 0 ? shift : j < 3 ? kSlopeBox : kCurvatureBox;
}

void SetBox(const std::vector<double>& half, ParameterBlock* block) {
  for (std::size_t j = 0; j < half.size(); ++j) {
    block->lower.push_back(block->start[j] - half[j]);
    block->upper.push_back(block->start[j] + half[j]);
  }
}

template <WarpKind kWarp, RadiometryKind kRadiometry>
ceres::CostFunction* CreateCost(const WindowResidual<kWarp, kRadiometry>& residual) {
  const int count = static_cast<int>(residual.pixels->size());
  using Residual = WindowResidual<kWarp, kRadiometry>;
  if constexpr (kRadiometry == RadiometryKind::kNone) {
    return new CompressedAutoDiffCostFunction<Residual, 1, WarpSize(kWarp)>(residual, count);
  } else {
    return new CompressedAutoDiffCostFunction<Residual, 1, WarpSize(kWarp), RadiometrySize(kRadiometry)>(
        residual, count);
  }
}

}  // namespace

WindowFit::WindowFit(const WindowImages& images, const WindowModel& model, int x, int y,
                     const WarpValues& start, const WindowFitOptions& options)
    : images_(images), model_(model), options_(options), x_(x), y_(y) {
  CheckWindowModel(model);
  images.Check();
  WindowPatch patch;
  patch.Load(images, model, x, y, start);
  if (!patch.HasEnoughPixels()) {
    throw FitError("the window at (" + std::to_string(x) + ", " + std::to_string(y) + ") has " +
                   std::to_string(patch.pixels) + " of its " + std::to_string(patch.size * patch.size) +
                   " pixels in both images and masks: a third is needed");
  }
  pixels_ = PixelsOf(patch);

  const int warp_size = WarpSize(model.warp), radiometry_size = RadiometrySize(model.radiometry);
  ParameterBlock warp{.name = "warp", .start = {start.begin(), start.begin() + warp_size}};
  std::vector<double> half;
  for (int j = 0; j < warp_size; ++j) half.push_back(WarpBox(model.warp, j, options.start_box));
  if (options.start_box > 0) SetBox(half, &warp);
  parameters_.push_back(std::move(warp));
  if (radiometry_size == 0) return;
  const RadiometryValues values = StartRadiometry(images, model, x, y, pixels_, start);
  ParameterBlock radiometry{.name = "radiometry",
                            .start = {values.begin(), values.begin() + radiometry_size}};
  if (options.start_box > 0) {
    SetBox({kRadiometryBox.begin(), kRadiometryBox.begin() + radiometry_size}, &radiometry);
  }
  parameters_.push_back(std::move(radiometry));
}

void WindowFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                             ceres::Problem* problem) const {
  WithWindowKinds(model_, [&](auto warp, auto radiometry) {
    const WindowResidual<warp.value, radiometry.value> residual{images_.right, x_, y_, &pixels_};
    problem->AddResidualBlock(CreateCost(residual), nullptr, blocks);
  });
}

double WindowFit::Objective(std::span<const double> x) const {
  return WithWindowKinds(model_, [&](auto warp, auto radiometry) {
    const WindowResidual<warp.value, radiometry.value> residual{images_.right, x_, y_, &pixels_};
    double sum = 0;
    for (int i = 0; i < static_cast<int>(pixels_.size()); ++i) {
      double r = 0;
      residual(i, x.data(), x.data() + WarpSize(warp.value), &r);
      sum += r * r;
    }
    return sum / 2;
  });
}

WindowMatch WindowFit::MatchAt(std::span<const double> x) const {
  WarpValues warp{};
  const int size = WarpSize(model_.warp);
  std::copy_n(x.begin(), size, warp.begin());
  WindowMatch match = DescribeWindow(images_, model_, x_, y_, warp);
  std::copy(x.begin() + size, x.end(), match.radiometry.begin());
  return match;
}

std::map<std::string, double> WindowFit::Metrics(std::span<const double> x) const {
  const WindowMatch match = MatchAt(x);
  std::map<std::string, double> metrics = {{"disparity", match.warp[0]},
                                           {"sigma", match.sigma},
                                           {"noise", match.noise},
                                           {"correlation", match.correlation}};
  if (options_.true_disparity) {
    const double error = std::abs(match.warp[0] - *options_.true_disparity);
    metrics["disparity_error"] = error;
    metrics["within_sigma"] = error <= match.sigma ? 1 : 0;
  }
  return metrics;
}

WindowMatch SolveWindow(const WindowImages& images, const WindowModel& model, int x, int y,
                        const WarpValues& start, const WindowFitOptions& options, const Solver& solver,
                        const Budget& budget, const SolveContext& context) {
  WindowMatch match;
  match.warp = start;
  WindowPatch patch;
  patch.Load(images, model, x, y, start);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!patch.HasEnoughPixels()) break;
    const WindowFit fit(images, model, x, y, match.warp, options);
    const SolverReport report = solver.Solve(fit, budget, context);
    const int iterations = match.iterations + report.iterations;
    const std::int64_t evaluations = match.evaluations + report.evaluations;
    if (report.termination == Termination::kFailed) {
      match.converged = false;
      break;
    }
    match = fit.MatchAt(report.x);
    match.iterations = iterations;
    match.evaluations = evaluations;
    if (!match.converged || !patch.Choose(images, model.warp, match.warp)) break;
  }
  return match;
}

}  // namespace frond
