// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/auto_diff_matcher.h"

#include <ceres/jet.h>
#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "problems/stereo/window_description.h"
#include "problems/stereo/window_dispatch.h"
#include "problems/stereo/window_pixels.h"

namespace frond {
namespace {

constexpr int kMaxRounds = 3;  // of choosing the pixels, as WindowMatcher does

// What ceres::TinySolver minimises: the rows of WindowResidual by Jets, compressed to kSize + 1 rows as
// solvers/compressed_rows.h does, at a fixed size.
template <WarpKind kWarp, RadiometryKind kRadiometry>
struct CompressedWindow {
  static constexpr int kWarpSize = WarpSize(kWarp), kSize = kWarpSize + RadiometrySize(kRadiometry);
  using Scalar = double;
  enum { NUM_RESIDUALS = kSize + 1, NUM_PARAMETERS = kSize };

  WindowResidual<kWarp, kRadiometry> residual;

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    return jacobian == nullptr ? EvaluateCost(x, residuals) : EvaluateRows(x, residuals, jacobian);
  }

 private:
  using Jet = ceres::Jet<double, kSize>;

  int Count() const { return static_cast<int>(residual.pixels->size()); }

  bool EvaluateCost(const double* x, double* residuals) const {
    double sum = 0;
    for (int i = 0; i < Count(); ++i) {
      double r;
      residual(i, x, x + kWarpSize, &r);
      sum += r * r;
    }
    std::fill_n(residuals, kSize, 0.0);
    residuals[kSize] = std::sqrt(sum);
    return std::isfinite(sum);
  }

  bool EvaluateRows(const double* x, double* residuals, double* jacobian) const {
    std::array<Jet, static_cast<std::size_t>(kSize)> jets;
    for (int j = 0; j < kSize; ++j) jets[static_cast<std::size_t>(j)] = Jet(x[j], j);
    Eigen::Matrix<double, kSize, kSize> H = Eigen::Matrix<double, kSize, kSize>::Zero();
    Eigen::Matrix<double, kSize, 1> g = Eigen::Matrix<double, kSize, 1>::Zero();
    double sum = 0;
    for (int i = 0; i < Count(); ++i) {
      Jet r;
      residual(i, jets.data(), jets.data() + kWarpSize, &r);
      H.noalias() += r.v * r.v.transpose();
      g.noalias() += r.v * r.a;
      sum += r.a * r.a;
    }
    const Eigen::LLT<Eigen::Matrix<double, kSize, kSize>> factor(H);
    if (!std::isfinite(sum) || factor.info() != Eigen::Success) return false;
    const Eigen::Matrix<double, kSize, 1> head = factor.matrixL().solve(g);
    Eigen::Map<Eigen::Matrix<double, kSize, 1>>(residuals, kSize) = head;
    residuals[kSize] = std::sqrt(std::max(0.0, sum - head.squaredNorm()));
    Eigen::Map<Eigen::Matrix<double, kSize + 1, kSize>> rows(jacobian);
    rows.setZero();
    rows.template topRows<kSize>() = factor.matrixU();
    return true;
  }
};

template <WarpKind kWarp, RadiometryKind kRadiometry>
bool Minimise(const WindowImages& images, const WindowModel& model, int x, int y,
              const std::vector<WindowPixel>& pixels, WindowMatch* match) {
  using Function = CompressedWindow<kWarp, kRadiometry>;
  const Function function{{images.right, x, y, &pixels}};
  typename ceres::TinySolver<Function>::Parameters values;
  const RadiometryValues start = StartRadiometry(images, model, x, y, pixels, match->warp);
  for (int j = 0; j < Function::kSize; ++j) {
    values[j] = j < Function::kWarpSize ? match->warp[static_cast<std::size_t>(j)]
                                        : start[static_cast<std::size_t>(j - Function::kWarpSize)];
  }
  ceres::TinySolver<Function> solver;
  // A step of 1e-6 px changes the cost by about 1e-8 grey levels², and rounding has a share of 1e-10.
  solver.options.function_tolerance = 1e-8;
  solver.options.parameter_tolerance = 1e-9;
  solver.options.gradient_tolerance = 1e-9;
  solver.options.initial_trust_region_radius = 1e8;
  std::array<double, Function::NUM_RESIDUALS> residuals;
  std::array<double, static_cast<std::size_t>(Function::NUM_RESIDUALS) * Function::NUM_PARAMETERS> jacobian;
  if (!function(values.data(), residuals.data(), jacobian.data()))
    return false;  // TinySolver would not notice
  const auto& summary = solver.Solve(function, &values);
  match->iterations += summary.iterations;
  for (int j = 0; j < Function::kWarpSize; ++j) match->warp[static_cast<std::size_t>(j)] = values[j];
  return values.allFinite() && summary.status != ceres::TinySolver<Function>::HIT_MAX_ITERATIONS;
}

}  // namespace

WindowMatch MatchByAutoDiff(const WindowImages& images, const WindowModel& model, int x, int y,
                            const WarpValues& start) {
  WindowMatch match;
  match.warp = start;
  WindowPatch patch;
  patch.Load(images, model, x, y, start);
  bool converged = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    converged = patch.HasEnoughPixels() && WithWindowKinds(model, [&](auto warp, auto radiometry) {
                  return Minimise<warp.value, radiometry.value>(images, model, x, y, PixelsOf(patch), &match);
                });
    if (!converged || !patch.Choose(images, model.warp, match.warp)) break;
  }
  if (!converged) return match;
  const int iterations = match.iterations;
  match = DescribeWindow(images, model, x, y, match.warp);
  match.iterations = iterations;
  return match;
}

}  // namespace frond
