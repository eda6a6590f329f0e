// SPDX-License-Identifier: BSD-3-Clause
// Eqs (34)-(39) against shapes whose errors are known.
#include "problems/surface/surface_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/nurbs_operations.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;

SurfaceErrors ErrorsOf(const Points& points, const NurbsSurface& surface,
                       const std::vector<Eigen::Vector2d>& parameters = {}) {
  return MeasureSurfaceErrors(points, parameters, MeasureDistances(points, surface, 1), {surface, {}}, 0, 1);
}

TEST(SurfaceErrors, PointsAbovePlane_HaveTheirHeightsAsErrors) {
  Points points;
  std::vector<Eigen::Vector2d> parameters;
  for (int i = 1; i <= 100; ++i) {
    points.emplace_back(2 + 0.05 * i, 1, 0.01 * i);
    parameters.emplace_back(0.5, 0.25);  // of 10 × 4: the plane's point (5, 1, 0)
  }
  const SurfaceErrors errors = ErrorsOf(points, PlaneSurface(2, 4, 10, 4), parameters);
  EXPECT_NEAR(errors.perpendicular_total, 0.01 * 5050, 1e-9);
  EXPECT_NEAR(errors.perpendicular_mean, 0.505, 1e-11);
  EXPECT_NEAR(errors.p50, 0.5, 1e-9);
  EXPECT_NEAR(errors.p99, 0.99, 1e-9);
  double relative = 0, parametric = 0;
  for (const auto& p : points) {
    relative += p.z() / std::hypot(p.x() - 5, p.y() - 2);
    parametric += (p - Eigen::Vector3d(5, 1, 0)).norm();
  }
  EXPECT_NEAR(errors.relative_total, relative, 1e-6 * relative);
  EXPECT_NEAR(errors.relative_mean, relative / 100, 1e-6 * relative);
  EXPECT_NEAR(errors.parametric_total.value(), parametric, 1e-9 * parametric);
  EXPECT_NEAR(errors.parametric_mean.value(), parametric / 100, 1e-9 * parametric);
}

TEST(SurfaceErrors, WithoutParameters_HaveNoParametricOnes) {
  EXPECT_FALSE(ErrorsOf({{1, 1, 1}}, PlaneSurface(1, 2)).parametric_total.has_value());
}

// A closed tube about the z axis whose radius grows with z: nearly round with 24 cubic spans.
NurbsSurface ClosedCone() {
  const BSplineBasis u = PeriodicUniformBasis(3, 24), v = UniformBasis(1, 2);
  Points control_points;
  for (int i = 0; i < u.num_control_points(); ++i) {
    for (int j = 0; j < 2; ++j) {
      const double angle = 2 * M_PI * i / 24, radius = j == 0 ? 10 : 20;
      control_points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 30 * j);
    }
  }
  return NurbsSurface(u, v, control_points);
}

TEST(SurfaceErrors, OfAClosedSurface_AreRelativeToTheIsoCurvesRadius) {
  const NurbsSurface tube = ClosedCone();
  EXPECT_LT((IsoCurveCentroid(tube, 0.5) - Eigen::Vector3d(0, 0, 15)).norm(), 1e-9);
  for (const double v : {0.2, 0.8}) {
    const SurfacePoint at = tube.EvaluateWithDerivatives(0.3, v);
    const double radius = at.position.head<2>().norm();
    const SurfaceErrors errors = ErrorsOf({at.position + 0.1 * at.Normal()}, tube);
    EXPECT_NEAR(errors.perpendicular_total, 0.1, 1e-7);
    EXPECT_NEAR(errors.relative_mean, 0.1 / radius, 1e-6);
  }
}

TEST(SurfaceErrors, UnitAndPose_ScaleLengthsAndLeaveShares) {
  const NurbsSurface tube = ClosedCone();
  Random random(4);
  Points points;
  for (int i = 0; i < 50; ++i) {
    points.push_back(tube.Evaluate(random.Uniform(), random.Uniform(0.1, 0.9)) + 0.2 * RandomVector(random));
  }
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = 1e-3 * Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  map.translation() = Eigen::Vector3d(4, -5, 6);
  Points moved;
  for (const auto& point : points) moved.push_back(map * point);
  const SurfaceErrors here = ErrorsOf(points, tube), there = ErrorsOf(moved, Transformed(tube, map));
  EXPECT_NEAR(there.perpendicular_total, 1e-3 * here.perpendicular_total, 1e-9);
  EXPECT_NEAR(there.relative_total, here.relative_total, 1e-7);
  EXPECT_NEAR(there.p90, 1e-3 * here.p90, 1e-9);
}

TEST(AreaCentroid, OfHalfATrimmedPlane_IsItsMiddle) {
  const TrimmedSurface half{PlaneSurface(1, 2, 4, 2), {{{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}}};
  EXPECT_LT((AreaCentroid(half) - Eigen::Vector3d(1, 1, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace frond
