// SPDX-License-Identifier: BSD-3-Clause
#include "models/newton_projection.h"

#include <gtest/gtest.h>

#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

TEST(DistanceRatioStart, OnAPlane_FollowsEquations7And8) {
  const NurbsSurface plane = PlaneSurface(2, 5, 4, 2);
  const Eigen::Vector3d g(1, 1.5, 0.5);
  const double a = (g - Eigen::Vector3d(0, 1, 0)).norm(), b = (g - Eigen::Vector3d(4, 1, 0)).norm();
  const double u = a / (a + b);
  const double c = (g - Eigen::Vector3d(4 * u, 0, 0)).norm(), d = (g - Eigen::Vector3d(4 * u, 2, 0)).norm();
  EXPECT_LT((DistanceRatioStart(plane, g) - Eigen::Vector2d(u, c / (c + d))).norm(), 1e-14);
}

TEST(ProjectByNewton, OntoAPlane_IsOneStepAway) {
  const NurbsSurface plane = PlaneSurface(3, 6, 4, 2);
  const NewtonProjection p = ProjectByNewton(plane, {1, 1.5, 0.5});
  EXPECT_LT((p.foot - Eigen::Vector3d(1, 1.5, 0)).norm(), 1e-10);
  EXPECT_NEAR(p.distance, 0.5, 1e-12);
  EXPECT_EQ(p.criterion, NewtonCriterion::kOrthogonality);
  EXPECT_LE(p.iterations, 2);
}

TEST(ProjectByNewton, OntoAPointOfTheSurface_EndsByCoincidence) {
  Random random(31);
  const NurbsSurface torus = ExactTorus(5, 2);
  const Eigen::Vector2d uv(0.3, 0.1);
  const NewtonProjection p =
      ProjectByNewton(torus, torus.Evaluate(uv.x(), uv.y()), uv + Eigen::Vector2d(0.02, -0.03));
  EXPECT_EQ(p.criterion, NewtonCriterion::kCoincidence);
  EXPECT_LT((p.parameters - uv).norm(), 1e-10);
}

TEST(ProjectByNewton, OntoSphere_MatchesRadialProjection) {
  const NurbsSurface sphere = ExactSphere(3);
  Random random(32);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector2d uv(random.Uniform(0.05, 0.95), random.Uniform(0.2, 0.8));
    const Eigen::Vector3d point = sphere.Evaluate(uv.x(), uv.y()) * random.Uniform(0.8, 1.5);
    const NewtonProjection p = ProjectByNewton(sphere, point, uv + Eigen::Vector2d(0.01, 0.01));
    EXPECT_LT((p.foot - 3 * point.normalized()).norm(), 1e-8);
    EXPECT_NEAR(p.distance, std::abs(point.norm() - 3), 1e-12);
  }
}

TEST(ProjectByNewton, BeyondTheEdge_StopsThereByTheStep) {
  const NurbsSurface plane = PlaneSurface(2, 4);
  const NewtonProjection p = ProjectByNewton(plane, {1.7, 0.4, 0.3});
  EXPECT_EQ(p.criterion, NewtonCriterion::kStep);
  EXPECT_LT((p.foot - Eigen::Vector3d(1, 0.4, 0)).norm(), 1e-10);
}

TEST(ProjectByNewton, WithoutSteps_ReportsTheLimit) {
  NewtonProjectionOptions options;
  options.max_iterations = 0;
  const NewtonProjection p = ProjectByNewton(PlaneSurface(2, 4), {0.1, 0.9, 1}, options);
  EXPECT_EQ(p.criterion, NewtonCriterion::kIterationLimit);
  EXPECT_EQ(p.iterations, 0);
}

TEST(ProjectByNewton, OnAPeriodicSurface_WrapsOverTheSeam) {
  Random random(33);
  std::vector<Eigen::Vector3d> points;
  const BSplineBasis u = PeriodicUniformBasis(3, 12), v = UniformBasis(1, 2);
  for (int i = 0; i < 15; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12;
    for (int j = 0; j < 2; ++j) points.emplace_back(std::cos(angle), std::sin(angle), j);
  }
  const NurbsSurface tube(u, v, points);
  const Eigen::Vector3d point = 1.2 * tube.Evaluate(0.98, 0.5) - Eigen::Vector3d(0, 0, 0.1);
  const NewtonProjection p = ProjectByNewton(tube, point, Eigen::Vector2d(0.03, 0.5));
  EXPECT_NEAR(p.parameters.x(), 0.98, 1e-3);
  EXPECT_NEAR(p.parameters.y(), 0.5, 1e-8);
}

}  // namespace
}  // namespace frond
