// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_matcher.h"

#include <cmath>

#include "problems/stereo/window_description.h"
#include "problems/stereo/window_dispatch.h"
#include "problems/stereo/window_statistics.h"
#include "problems/stereo/window_system.h"

namespace frond {
namespace {

// Rounds of choosing the pixels at the warp found: they settle at once but at silhouettes.
constexpr int kMaxRounds = 3;

// A step below this (px) is near enough for the residuals' curvature: noise makes Gauss–Newton converge at a
// rate of 0.3 and worse, Newton in one or two steps more.
constexpr double kNewtonStep = 0.3;

// Damping of Levenberg and Marquardt: none until a step fails.
constexpr double kFirstDamping = 1e-3;
constexpr double kLargestDamping = 1e6;

template <WarpKind kWarp, RadiometryKind kRadiometry>
class Matching {
 public:
  using System = WindowSystem<kWarp, kRadiometry>;
  static constexpr int kP = System::kP, kQ = System::kQ;
  using Step = Eigen::Matrix<double, kP, 1>;

  Matching(const WindowImages& images, const WindowModel& model, const InterpolationNoise& noise,
           const WindowMatcherOptions& options)
      : images_(images), model_(model), noise_(noise), options_(options) {}

  WindowMatch Match(int x, int y, const WarpValues& start) {
    WindowMatch match;
    match.warp = start;
    patch_.Load(images_, model_, x, y, start);
    for (int round = 0; round < kMaxRounds; ++round) {
      match.pixels = patch_.pixels;
      match.converged = patch_.HasEnoughPixels() && system_.SetPatch(&patch_) && Minimise(&match);
      if (!match.converged || !patch_.Choose(images_, kWarp, match.warp)) break;
    }
    if (match.converged) Describe<kWarp, kRadiometry>(patch_, samples_, reduced_, noise_, &match);
    return match;
  }

  // At the warp alone.
  WindowMatch DescribeAt(int x, int y, const WarpValues& warp) {
    WindowMatch match;
    match.warp = warp;
    patch_.Load(images_, model_, x, y, warp);
    match.pixels = patch_.pixels;
    if (!patch_.HasEnoughPixels() || !system_.SetPatch(&patch_)) return match;
    system_.Evaluate(*images_.right, warp.data(), nullptr, &samples_, &reduced_);
    match.radiometry = RadiometryAfter(Step::Zero());
    match.converged = true;
    Describe<kWarp, kRadiometry>(patch_, samples_, reduced_, noise_, &match);
    return match;
  }

 private:
  // Leaves the samples and the system of a point within the last, small step of the minimum.
  bool Minimise(WindowMatch* match) {
    system_.Evaluate(*images_.right, match->warp.data(), nullptr, &samples_, &reduced_);
    double damping = 0;
    for (int i = 0; i < options_.max_iterations && damping <= kLargestDamping; ++i) {
      ++match->iterations;
      Step step;
      if (!Solve(damping, &step)) {
        damping = std::max(kFirstDamping, 10 * damping);
        continue;
      }
      WarpValues trial = match->warp;
      for (int j = 0; j < kP; ++j) trial[static_cast<std::size_t>(j)] += step[j];
      if (LargestChange(step) < options_.tolerance && damping < 1) {
        match->radiometry = RadiometryAfter(step);
        match->warp = trial;
        return true;
      }
      typename System::Reduced next;
      const RadiometryValues radiometry = RadiometryAfter(step);
      const bool near = LargestChange(step) < kNewtonStep;
      system_.Evaluate(*images_.right, trial.data(), near ? radiometry.data() : nullptr, &samples_, &next);
      if (next.f <= reduced_.f + next.rounding) {
        match->warp = trial;
        reduced_ = next;
        damping = damping <= kFirstDamping ? 0 : damping / 10;
      } else {
        damping = std::max(kFirstDamping, 10 * damping);
      }
    }
    return false;
  }

  // By Newton's matrix, or Gauss–Newton's where that is not positive definite.
  bool Solve(double damping, Step* step) const {
    return SolveWith(reduced_.H + reduced_.curvature, damping, step) || SolveWith(reduced_.H, damping, step);
  }

  bool SolveWith(Eigen::Matrix<double, kP, kP> H, double damping, Step* step) const {
    H.diagonal() *= 1 + damping;
    const Eigen::LLT<Eigen::Matrix<double, kP, kP>> factor(H);
    if (factor.info() != Eigen::Success) return false;
    *step = factor.solve(reduced_.s);
    return step->allFinite() && LargestChange(*step) < model_.size;
  }

  // Of the disparity, anywhere in the window.
  double LargestChange(const Step& step) const {
    const double h = patch_.half;
    double change = std::abs(step[0]);
    if constexpr (kWarp != WarpKind::kShift) change += h * (std::abs(step[1]) + std::abs(step[2]));
    if constexpr (kWarp == WarpKind::kQuadratic) change += h * h * step.template tail<3>().cwiseAbs().sum();
    if constexpr (kWarp == WarpKind::kAffine) {
      change = std::max(change, std::abs(step[3]) + h * (std::abs(step[4]) + std::abs(step[5])));
    }
    return change;
  }

  RadiometryValues RadiometryAfter(const Step& step) const {
    RadiometryValues values{1, 0, 0, 0};
    if constexpr (kQ > 0) {
      const Eigen::Matrix<double, kQ, 1> c = reduced_.y - reduced_.X * step;
      for (int j = 0; j < kQ; ++j) values[static_cast<std::size_t>(j)] = c[j];
    }
    return values;
  }

  const WindowImages& images_;
  const WindowModel& model_;
  const InterpolationNoise& noise_;
  const WindowMatcherOptions& options_;
  WindowPatch patch_;
  WindowSamples samples_;
  System system_;
  typename System::Reduced reduced_;
};

}  // namespace

WindowMatcher::WindowMatcher(const Image& left, const Mask& left_mask, const CubicImage& right,
                             const Mask& right_mask, WindowModel model, WindowMatcherOptions options)
    : images_{&left, &left_mask, &right, &right_mask},
      model_(model),
      options_(options),
      noise_(model.smoothing) {
  CheckWindowModel(model);
  images_.Check();
}

WindowMatch WindowMatcher::Match(int x, int y, const WarpValues& start) const {
  return WithWindowKinds(model_, [&](auto warp, auto radiometry) {
    return Matching<warp.value, radiometry.value>(images_, model_, noise_, options_).Match(x, y, start);
  });
}

WindowMatch DescribeWindow(const WindowImages& images, const WindowModel& model, int x, int y,
                           const WarpValues& warp) {
  const WindowMatcherOptions options;
  const InterpolationNoise noise(model.smoothing);
  return WithWindowKinds(model, [&](auto kind, auto radiometry) {
    return Matching<kind.value, radiometry.value>(images, model, noise, options).DescribeAt(x, y, warp);
  });
}

}  // namespace frond
