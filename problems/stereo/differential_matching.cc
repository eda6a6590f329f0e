// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/differential_matching.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "problems/stereo/window_description.h"
#include "problems/stereo/window_dispatch.h"
#include "problems/stereo/window_system.h"

namespace frond {
namespace {

template <WarpKind kWarp, RadiometryKind kRadiometry>
class Differential {
 public:
  using System = WindowSystem<kWarp, kRadiometry>;
  static constexpr int kP = System::kP;
  using Step = Eigen::Matrix<double, kP, 1>;

  Differential(const WindowImages& images, const DifferentialOptions& options)
      : images_(images), options_(options) {}

  WindowMatch Match(const WindowModel& model, int x, int y, const WarpValues& start) {
    WindowMatch match;
    match.warp = start;
    patch_.Load(images_, model, x, y, start);
    match.pixels = patch_.pixels;
    if (!patch_.HasEnoughPixels() || !system_.SetPatch(&patch_)) return match;
    bool small = false;
    for (int i = 0; i < options_.iterations && !small; ++i) {
      Step step;
      system_.Evaluate(*images_.right, match.warp.data(), nullptr, &samples_, &reduced_);
      if (!Solve(&step) || !step.allFinite() || std::abs(step[0]) > patch_.half) return match;
      for (int j = 0; j < kP; ++j) match.warp[static_cast<std::size_t>(j)] += step[j];
      ++match.iterations;
      small = step.cwiseAbs().maxCoeff() < options_.tolerance;
    }
    match.converged = options_.iterations == 1 || small;
    return match;
  }

 private:
  bool Solve(Step* step) const {
    if (options_.method == DifferentialMethod::kClassical) return SolveClassical(step);
    // R₀ = aL + b − S δ with a, b eliminated: the first step of Gauss and Newton.
    const Eigen::LLT<Eigen::Matrix<double, kP, kP>> factor(reduced_.H);
    *step = factor.solve(reduced_.s);
    return factor.info() == Eigen::Success;
  }

  // R₀ − L = S δ − β: the gain is 1 by assumption.
  bool SolveClassical(Step* step) const {
    using Unknowns = Eigen::Matrix<double, kP + 1, 1>;
    Eigen::Matrix<double, kP + 1, kP + 1> H = Eigen::Matrix<double, kP + 1, kP + 1>::Zero();
    Unknowns g = Unknowns::Zero();
    for (int row = 0; row < patch_.size; ++row) {
      for (int k = 0; k < patch_.size; ++k) {
        const int i = row * patch_.stride + k;
        Unknowns a;
        const auto slope_row =
            System::SlopeRow(samples_.slope[i], samples_.slope_y[i], k - patch_.half, row - patch_.half);
        for (int j = 0; j < kP; ++j) a[j] = slope_row[j];
        a[kP] = -patch_.weight[i];
        const double level = System::kQ == 0 ? 0 : patch_.level[i];  // else taken off by the samples
        H += a * a.transpose();
        g += a * (samples_.value[i] - level);
      }
    }
    const Eigen::LLT<Eigen::Matrix<double, kP + 1, kP + 1>> factor(H);
    const Unknowns solution = factor.solve(g);
    for (int j = 0; j < kP; ++j) (*step)[j] = solution[j];
    return factor.info() == Eigen::Success;
  }

  const WindowImages& images_;
  const DifferentialOptions& options_;
  WindowPatch patch_;
  WindowSamples samples_;
  System system_;
  typename System::Reduced reduced_;
};

}  // namespace

WindowMatch MatchDifferentially(const WindowImages& images, const WindowModel& model, int x, int y,
                                const WarpValues& start, const DifferentialOptions& options) {
  const WindowMatch found = WithWindowKinds(model, [&](auto warp, auto radiometry) {
    return Differential<warp.value, radiometry.value>(images, options).Match(model, x, y, start);
  });
  if (!found.converged) return found;
  WindowMatch match = DescribeWindow(images, model, x, y, found.warp);
  match.iterations = found.iterations;
  return match;
}

}  // namespace frond
