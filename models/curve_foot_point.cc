// SPDX-License-Identifier: BSD-3-Clause
#include "models/curve_foot_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frond {
namespace {

constexpr int kHalvings = 12;
constexpr double kRounding = 1e-14;
constexpr double kLongestStep = 0.25;  // of the domain

}  // namespace

CurveFoot RefineCurveFoot(const CurveSpans& spans, const Eigen::Vector3d& point, double t,
                          const CurveFootOptions& options) {
  const BSplineBasis& basis = spans.basis();
  const double begin = basis.begin(), end = basis.end(), longest = kLongestStep * (end - begin);
  CurveFoot foot;
  foot.t = basis.IntoDomain(t);
  CurvePoint c = spans.EvaluateWithDerivatives(foot.t);
  foot.squared_distance = (c.position - point).squaredNorm();
  bool converged = false;
  for (int iteration = 0; iteration < options.max_iterations && !converged; ++iteration) {
    const Eigen::Vector3d r = c.position - point;
    const double gradient = r.dot(c.d1), squared_speed = c.d1.squaredNorm();
    const double newton = squared_speed + r.dot(c.d2);
    const double slope = newton > 0 ? newton : squared_speed;
    if (!(slope > 0)) break;
    double step = std::clamp(-gradient / slope, -longest, longest);
    if (!basis.periodic()) step = std::clamp(foot.t + step, begin, end) - foot.t;
    converged = std::abs(step) * std::sqrt(squared_speed) <= options.step_tolerance;
    bool moved = false;
    for (int halving = 0; halving < kHalvings && step != 0; ++halving, step /= 2) {
      const double next = basis.IntoDomain(foot.t + step);
      const CurvePoint tried = spans.EvaluateWithDerivatives(next);
      const double squared = (tried.position - point).squaredNorm();
      // Where distances differ by rounding alone the gradient still tells the nearer one.
      const bool nearer = squared < foot.squared_distance ||
                          (squared <= (1 + kRounding) * foot.squared_distance &&
                           std::abs((tried.position - point).dot(tried.d1)) < std::abs(gradient));
      if (nearer) {
        foot.t = next;
        foot.squared_distance = squared;
        c = tried;
        moved = true;
        break;
      }
      if (converged) break;  // the step was negligible; rounding alone speaks against it
    }
    if (!moved) break;
  }
  if (!basis.periodic()) {
    const double gradient = (c.position - point).dot(c.d1);
    foot.at_end = (foot.t == begin && gradient > 0) || (foot.t == end && gradient < 0);
  }
  return foot;
}

CurveFootSearch::CurveFootSearch(const CurveSpans& spans, int per_span) : spans_(&spans) {
  for (int k = 0; k < spans.count(); ++k) {
    for (int i = 0; i < per_span; ++i) {
      parameters_.push_back(spans.polynomials().begin(k) + spans.polynomials().length(k) * i / per_span);
    }
  }
  const bool periodic = spans.basis().periodic();
  if (!periodic) parameters_.push_back(spans.basis().end());
  double size = 0;
  for (const double t : parameters_) {
    samples_.push_back(spans.Evaluate(t));
    size = std::max(size, (samples_.back() - samples_.front()).norm());
  }
  options_.step_tolerance = 1e-9 * size;
  const std::size_t n = samples_.size();
  reach_.assign(n, 0);
  for (std::size_t i = 0; i + (periodic ? 0 : 1) < n; ++i) {
    // No curve of so fine samples is much longer than their chords.
    const double arc = 1.5 * (samples_[(i + 1) % n] - samples_[i]).norm();
    reach_[i] = std::max(reach_[i], arc);
    reach_[(i + 1) % n] = std::max(reach_[(i + 1) % n], arc);
  }
}

CurveFoot CurveFootSearch::Find(const Eigen::Vector3d& point) const {
  const std::size_t n = samples_.size();
  const bool periodic = spans_->basis().periodic();
  thread_local std::vector<double> squared;
  squared.resize(n);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    squared[i] = (samples_[i] - point).squaredNorm();
    if (squared[i] < squared[nearest]) nearest = i;
  }
  CurveFoot best = RefineCurveFoot(*spans_, point, parameters_[nearest], options_);
  double distance = std::sqrt(best.squared_distance);
  for (std::size_t i = 0; i < n; ++i) {
    const double bound = distance + reach_[i];
    if (i == nearest || squared[i] > bound * bound) continue;
    const bool below_last = i > 0 ? squared[i] <= squared[i - 1] : !periodic || squared[i] <= squared[n - 1];
    const bool below_next = i + 1 < n ? squared[i] <= squared[i + 1] : !periodic || squared[i] <= squared[0];
    if (!below_last || !below_next) continue;
    const CurveFoot foot = RefineCurveFoot(*spans_, point, parameters_[i], options_);
    if (foot.squared_distance >= best.squared_distance) continue;
    best = foot;
    distance = std::sqrt(best.squared_distance);
  }
  return best;
}

CurveFoot CurveFootSearch::FindFrom(const Eigen::Vector3d& point, double t) const {
  const CurveFoot found = Find(point), refined = RefineCurveFoot(*spans_, point, t, options_);
  return refined.squared_distance < found.squared_distance ? refined : found;
}

}  // namespace frond
