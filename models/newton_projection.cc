// SPDX-License-Identifier: BSD-3-Clause
#include "models/newton_projection.h"

#include <Eigen/LU>
#include <cmath>

namespace frond {
namespace {

// a / (a + b), or the middle where both vanish.
double Ratio(double a, double b) { return a + b > 0 ? a / (a + b) : 0.5; }

double OnDomain(const BSplineBasis& basis, double fraction) {
  return basis.begin() + fraction * (basis.end() - basis.begin());
}

// Criterion (2), multiplied out: true, too, where the derivative vanishes (a collapsed edge).
bool IsOrthogonal(const Eigen::Vector3d& r, const SurfacePoint& s, double tolerance) {
  return std::abs(s.du.dot(r)) <= tolerance * s.du.norm() * r.norm() &&
         std::abs(s.dv.dot(r)) <= tolerance * s.dv.norm() * r.norm();
}

// The step that was taken from `before` to `after`; across the seam of a periodic direction, the short way.
double Step(const BSplineBasis& basis, double before, double after) {
  const double step = after - before;
  return basis.periodic() ? std::remainder(step, basis.end() - basis.begin()) : step;
}

}  // namespace

Eigen::Vector2d DistanceRatioStart(const NurbsSurface& surface, const Eigen::Vector3d& point) {
  const BSplineBasis &basis_u = surface.u(), &basis_v = surface.v();
  const auto distance = [&](double u, double v) { return (point - surface.Evaluate(u, v)).norm(); };
  const double middle_v = OnDomain(basis_v, 0.5);
  const double u =
      OnDomain(basis_u, Ratio(distance(basis_u.begin(), middle_v), distance(basis_u.end(), middle_v)));
  const double v = OnDomain(basis_v, Ratio(distance(u, basis_v.begin()), distance(u, basis_v.end())));
  return {u, v};
}

NewtonProjection ProjectByNewton(const NurbsSurface& surface, const Eigen::Vector3d& point,
                                 const NewtonProjectionOptions& options) {
  return ProjectByNewton(surface, point, DistanceRatioStart(surface, point), options);
}

NewtonProjection ProjectByNewton(const NurbsSurface& surface, const Eigen::Vector3d& point,
                                 const Eigen::Vector2d& start, const NewtonProjectionOptions& options) {
  double u = surface.u().IntoDomain(start[0]), v = surface.v().IntoDomain(start[1]);
  SurfacePoint s = surface.EvaluateWithDerivatives(u, v);
  const auto result = [&](int iterations, NewtonCriterion criterion) {
    return NewtonProjection{{u, v}, s.position, (s.position - point).norm(), iterations, criterion};
  };
  for (int k = 0;; ++k) {
    const Eigen::Vector3d r = s.position - point;
    if (r.norm() <= options.length_tolerance) return result(k, NewtonCriterion::kCoincidence);
    if (IsOrthogonal(r, s, options.cosine_tolerance)) return result(k, NewtonCriterion::kOrthogonality);
    if (k >= options.max_iterations) return result(k, NewtonCriterion::kIterationLimit);
    const double mixed = s.du.dot(s.dv) + r.dot(s.duv);
    const Eigen::Matrix2d jacobian{{s.du.squaredNorm() + r.dot(s.duu), mixed},
                                   {mixed, s.dv.squaredNorm() + r.dot(s.dvv)}};
    const Eigen::FullPivLU<Eigen::Matrix2d> factors(jacobian);
    if (!factors.isInvertible()) return result(k, NewtonCriterion::kSingular);
    const Eigen::Vector2d delta = factors.solve(-Eigen::Vector2d(r.dot(s.du), r.dot(s.dv)));
    const double next_u = surface.u().IntoDomain(u + delta[0]);
    const double next_v = surface.v().IntoDomain(v + delta[1]);
    const Eigen::Vector3d moved = Step(surface.u(), u, next_u) * s.du + Step(surface.v(), v, next_v) * s.dv;
    u = next_u;
    v = next_v;
    s = surface.EvaluateWithDerivatives(u, v);
    if (moved.norm() <= options.length_tolerance) return result(k + 1, NewtonCriterion::kStep);
  }
}

}  // namespace frond
