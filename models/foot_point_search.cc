// SPDX-License-Identifier: BSD-3-Clause
#include "models/foot_point_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

// At which bound one coordinate stands, if at any, when the objective falls outwards. A pole is no bound.
bool HeldAtBound(const BSplineBasis& basis, double t, double gradient, PoleEnds poles = {}) {
  if (basis.periodic()) return false;
  return (t <= basis.begin() && gradient > 0 && !poles.begin) ||
         (t >= basis.end() && gradient < 0 && !poles.end);
}

// (u, v) after a step. In the span of v next to a pole (u, v) are polar coordinates of the tangent plane
// there: the step is taken in that plane, so that it may lead past the pole, to u half a turn on. Feet keep
// kFromPole of the span away from the pole itself, where u has no meaning.
Eigen::Vector2d Moved(const SurfaceCells& cells, double u, double v, const Eigen::Vector2d& step) {
  constexpr double kFromPole = 1e-5;
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  const SpanPolynomials& spans = cells.v();
  const int last = spans.count() - 1;
  const double first_length = spans.length(0), last_length = spans.length(last);
  const bool at_begin = cells.poles().begin && std::min(v, v + step[1]) < bv.begin() + first_length;
  const bool at_end = !at_begin && cells.poles().end && std::max(v, v + step[1]) > bv.end() - last_length;
  if (!at_begin && !at_end) return {bu.IntoDomain(u + step[0]), bv.IntoDomain(v + step[1])};
  const double turn = 2 * std::numbers::pi / (bu.end() - bu.begin());
  const double radius = at_begin ? v - bv.begin() : bv.end() - v;
  const double along = radius + (at_begin ? step[1] : -step[1]), across = radius * turn * step[0];
  const double moved =
      std::max(std::hypot(along, across), kFromPole * (at_begin ? first_length : last_length));
  return {bu.IntoDomain(u + std::atan2(across, along) / turn),
          bv.IntoDomain(at_begin ? bv.begin() + moved : bv.end() - moved)};
}

struct Quadratic {
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian;
};

// ½|S − Q|² to second order; Gauss–Newton's matrix where Newton's is not safely positive definite.
Quadratic Model(const SurfaceCells::Jet2& s, const Eigen::Vector3d& r) {
  Quadratic model;
  model.gradient = {r.dot(s.du), r.dot(s.dv)};
  const double a = s.du.squaredNorm(), b = s.du.dot(s.dv), c = s.dv.squaredNorm();
  const double na = a + r.dot(s.duu), nb = b + r.dot(s.duv), nc = c + r.dot(s.dvv);
  if (na > 0.1 * a && nc > 0.1 * c && na * nc - nb * nb > 0.05 * (a * c - b * b)) {
    model.hessian << na, nb, nb, nc;
  } else {
    const double tiny = 1e-12 * (a + c);  // degenerate edges: S_u may vanish
    model.hessian << a + tiny, b, b, c + tiny;
  }
  return model;
}

Eigen::Vector2d BoxStep(const Quadratic& model, bool hold_u, bool hold_v) {
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  if (!hold_u && !hold_v) {
    const double det = model.hessian(0, 0) * model.hessian(1, 1) - model.hessian(0, 1) * model.hessian(1, 0);
    step[0] = -(model.hessian(1, 1) * model.gradient[0] - model.hessian(0, 1) * model.gradient[1]) / det;
    step[1] = -(model.hessian(0, 0) * model.gradient[1] - model.hessian(1, 0) * model.gradient[0]) / det;
  } else if (!hold_u) {
    step[0] = -model.gradient[0] / model.hessian(0, 0);
  } else if (!hold_v) {
    step[1] = -model.gradient[1] / model.hessian(1, 1);
  }
  return step.allFinite() ? step : Eigen::Vector2d::Zero();
}

}  // namespace

FootPoint RefineFootPoint(const SurfaceCells& cells, const Eigen::Vector3d& point, double u, double v,
                          const FootPointOptions& options) {
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  FootPoint foot;
  const PoleEnds poles = cells.poles();
  const Eigen::Vector2d start = Moved(cells, bu.IntoDomain(u), bv.IntoDomain(v), Eigen::Vector2d::Zero());
  foot.u = start[0];
  foot.v = start[1];
  SurfaceCells::Jet2 s = cells.Evaluate2(foot.u, foot.v);
  Eigen::Vector3d r = s.position - point;
  foot.squared_distance = r.squaredNorm();
  bool last_step = false;
  for (int iteration = 0; iteration <= options.max_iterations; ++iteration) {
    const Quadratic model = Model(s, r);
    const bool new_u = HeldAtBound(bu, foot.u, model.gradient[0]) != foot.at_edge_u;
    const bool new_v = HeldAtBound(bv, foot.v, model.gradient[1], poles) != foot.at_edge_v;
    foot.at_edge_u ^= new_u;
    foot.at_edge_v ^= new_v;
    if (last_step && !new_u && !new_v) {
      foot.converged = true;
      break;
    }
    Eigen::Vector2d step = BoxStep(model, foot.at_edge_u, foot.at_edge_v);
    if (iteration == options.max_iterations) break;
    if (-model.gradient.dot(step) <= 1e-15 * foot.squared_distance) {
      foot.converged = true;  // what is left to gain is below rounding
      break;
    }
    bool improved = false;
    double moved = 0;
    for (int halving = 0; halving < 8 && !improved; ++halving, step *= 0.5) {
      const Eigen::Vector2d next = Moved(cells, foot.u, foot.v, step);
      const double nu = next[0], nv = next[1];
      const double su = bu.periodic() ? step[0] : nu - foot.u;
      const double sv = bv.periodic() || poles.any() ? step[1] : nv - foot.v;
      moved = (su * s.du + sv * s.dv).norm();
      const SurfaceCells::Jet2 trial = cells.Evaluate2(nu, nv);
      const Eigen::Vector3d trial_r = trial.position - point;
      const double squared = trial_r.squaredNorm();
      if (squared < foot.squared_distance) {
        improved = true;
        foot.u = nu;
        foot.v = nv;
        foot.squared_distance = squared;
        s = trial;
        r = trial_r;
      }
    }
    if (!improved) {
      foot.converged = true;  // no smaller distance along a descent direction
      break;
    }
    last_step = moved <= options.step_tolerance;
  }
  return foot;
}

namespace {

// Grid lines: `per_span` in every span, and the domain's end where it is not closed.
std::vector<double> GridLines(const SpanPolynomials& spans, int per_span, bool closed) {
  std::vector<double> t;
  for (int k = 0; k < spans.count(); ++k) {
    for (int i = 0; i < per_span; ++i) t.push_back(spans.begin(k) + spans.length(k) * i / per_span);
  }
  if (!closed) t.push_back(spans.begin(spans.count() - 1) + spans.length(spans.count() - 1));
  return t;
}

// Mean lengths of the lines along u and along v, from a coarse grid.
Eigen::Vector2d MeanLengths(const SurfaceCells& cells) {
  constexpr int kLines = 12;
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  const double du = (bu.end() - bu.begin()) / kLines, dv = (bv.end() - bv.begin()) / kLines;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kLines; ++i) {
    for (int j = 0; j < kLines; ++j) {
      const auto jet = cells.Evaluate1(bu.begin() + (i + 0.5) * du, bv.begin() + (j + 0.5) * dv);
      sum += Eigen::Vector2d(jet.du.norm() * du, jet.dv.norm() * dv);
    }
  }
  return sum / kLines;
}

double LongestSpan(const SpanPolynomials& spans) {
  double length = 0;
  for (int k = 0; k < spans.count(); ++k) length = std::max(length, spans.length(k));
  return length;
}

}  // namespace

FootPointSearch::FootPointSearch(const SurfaceCells& cells, int samples) : cells_(&cells) {
  constexpr double kLargestRatio = 8;  // of the lines' numbers
  const Eigen::Vector2d lengths = MeanLengths(cells);
  const double ratio = lengths[0] > 0 && lengths[1] > 0
                           ? std::clamp(lengths[0] / lengths[1], 1 / kLargestRatio, kLargestRatio)
                           : 1;
  const double lines_u = std::sqrt(samples * ratio), lines_v = std::sqrt(samples / ratio);
  const int per_span_u = static_cast<int>(std::ceil(lines_u / cells.u().count()));
  const int per_span_v = static_cast<int>(std::ceil(lines_v / cells.v().count()));
  Eigen::AlignedBox3d box;
  const std::vector<double> us = GridLines(cells.u(), per_span_u, cells.basis_u().periodic());
  const std::vector<double> vs = GridLines(cells.v(), per_span_v, cells.basis_v().periodic());
  double squared_spacing = 0;
  for (const double u : us) {
    for (const double v : vs) {
      samples_.push_back(cells.Evaluate(u, v));
      parameters_.emplace_back(u, v);
      box.extend(samples_.back());
      const std::size_t k = samples_.size() - 1;
      if (k % vs.size() > 0)
        squared_spacing = std::max(squared_spacing, (samples_[k] - samples_[k - 1]).squaredNorm());
      if (k >= vs.size()) {
        squared_spacing = std::max(squared_spacing, (samples_[k] - samples_[k - vs.size()]).squaredNorm());
      }
    }
  }
  sample_spacing_ = std::sqrt(squared_spacing);
  step_u_ = LongestSpan(cells.u()) / per_span_u;
  step_v_ = LongestSpan(cells.v()) / per_span_v;
  options_.step_tolerance = 1e-6 * box.diagonal().norm();
  tree_ = std::make_unique<KdTree>(samples_);
}

FootPoint FootPointSearch::Find(const Eigen::Vector3d& point, int seeds) const {
  constexpr std::size_t kMostSeeds = 8, kMostSamples = 64;
  const Eigen::Vector2d& first = parameters_[tree_->Nearest(point).index];
  FootPoint best = RefineFootPoint(*cells_, point, first[0], first[1], options_);
  if (seeds <= 1) return best;
  std::array<Eigen::Vector2d, 2 * kMostSeeds> explored = {first, Eigen::Vector2d(best.u, best.v)};
  std::size_t num_explored = 2;
  std::array<KdTree::Neighbour, kMostSamples> nearest;
  const double reach = std::sqrt(best.squared_distance) + sample_spacing_;
  const std::size_t found = tree_->Nearest(point, nearest, reach);
  const std::size_t most = 2 * std::min<std::size_t>(static_cast<std::size_t>(seeds), kMostSeeds);
  for (std::size_t k = 1; k < found && num_explored < most; ++k) {
    const Eigen::Vector2d& start = parameters_[nearest[k].index];
    const bool seen = std::any_of(
        explored.begin(), explored.begin() + static_cast<std::ptrdiff_t>(num_explored),
        [&](const Eigen::Vector2d& uv) {
          return std::abs(start[0] - uv[0]) <= 2.5 * step_u_ && std::abs(start[1] - uv[1]) <= 2.5 * step_v_;
        });
    if (seen) continue;
    const FootPoint foot = RefineFootPoint(*cells_, point, start[0], start[1], options_);
    explored[num_explored++] = start;
    explored[num_explored++] = {foot.u, foot.v};
    if (foot.squared_distance < best.squared_distance) best = foot;
  }
  return best;
}

FootPoint FootPointSearch::FindFrom(const Eigen::Vector3d& point, double u, double v, int seeds) const {
  const FootPoint near = RefineFootPoint(*cells_, point, u, v, options_);
  const FootPoint global = Find(point, seeds);
  return near.squared_distance <= global.squared_distance ? near : global;
}

}  // namespace frond
