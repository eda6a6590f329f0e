// SPDX-License-Identifier: BSD-3-Clause
#include "models/curvature.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

TEST(Curvature, OfSphere_IsTheInverseRadius) {
  const NurbsSurface sphere = ExactSphere(4);
  Random random(21);
  for (int trial = 0; trial < 100; ++trial) {
    const auto c = CurvatureOf(sphere.EvaluateWithDerivatives(random.Uniform(), random.Uniform(0.02, 0.98)));
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->kappa1, -0.25, 1e-9);
    EXPECT_NEAR(c->kappa2, -0.25, 1e-9);
    EXPECT_NEAR(c->Gaussian(), 1.0 / 16, 1e-9);
    EXPECT_NEAR(c->Mean(), -0.25, 1e-9);
  }
}

TEST(Curvature, OfCylinder_IsAlongItsRulingsAndCircles) {
  const NurbsSurface cylinder = ExactCylinder(2, 7);
  for (int k = 0; k < 20; ++k) {
    const SurfacePoint p = cylinder.EvaluateWithDerivatives(k / 20.0, 0.3);
    const auto c = CurvatureOf(p);
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->kappa1, 0, 1e-12);
    EXPECT_NEAR(c->kappa2, -0.5, 1e-12);
    EXPECT_NEAR(std::abs(c->direction1.z()), 1, 1e-12);
    EXPECT_NEAR(c->direction2.z(), 0, 1e-12);
    EXPECT_LT((c->direction1.cross(c->direction2) - p.Normal()).norm(), 1e-12);
  }
}

TEST(Curvature, OfTorus_FollowsItsFormula) {
  const NurbsSurface torus = ExactTorus(5, 2);
  Random random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const SurfacePoint p = torus.EvaluateWithDerivatives(random.Uniform(), random.Uniform());
    const double rho = std::hypot(p.position.x(), p.position.y());  // R + r cos θ
    const double parallel = -((rho - 5) / 2) / rho;
    const auto c = CurvatureOf(p);
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->kappa1, parallel, 1e-10);
    EXPECT_NEAR(c->kappa2, -0.5, 1e-10);
  }
}

TEST(Curvature, OfReparametrisedSaddle_DoesNotDependOnParameters) {
  // z = x²/2 − y² at the origin under a sheared parametrisation x = 2u + v, y = v.
  SurfacePoint p;
  p.position.setZero();
  p.du = {2, 0, 0};
  p.dv = {1, 1, 0};
  p.duu = {0, 0, 4};
  p.duv = {0, 0, 2};
  p.dvv = {0, 0, 1 - 2};
  const auto c = CurvatureOf(p);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->kappa1, 1, 1e-14);
  EXPECT_NEAR(c->kappa2, -2, 1e-14);
  EXPECT_NEAR(std::abs(c->direction1.x()), 1, 1e-14);
}

TEST(Curvature, AtACollapsedEdge_IsEmpty) {
  EXPECT_FALSE(CurvatureOf(ExactSphere(1).EvaluateWithDerivatives(0.2, 0)));
}

}  // namespace
}  // namespace frond
