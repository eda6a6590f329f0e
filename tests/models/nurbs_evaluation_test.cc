// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "base/errors.h"
#include "models/nurbs_operations.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

TEST(NurbsCurve, RationalCircle_HasItsRadiusAndCurvatureEverywhere) {
  const NurbsCurve circle = ExactCircle(2.5);
  for (int k = 0; k <= 100; ++k) {
    const CurvePoint c = circle.EvaluateWithDerivatives(k / 100.0);
    EXPECT_NEAR(c.position.norm(), 2.5, 1e-14);
    EXPECT_NEAR(c.d1.dot(c.position), 0, 1e-12);
    EXPECT_NEAR(c.d1.cross(c.d2).norm() / std::pow(c.d1.norm(), 3), 1 / 2.5, 1e-12);
    EXPECT_LT((circle.Evaluate(k / 100.0) - c.position).norm(), 1e-15);
  }
}

TEST(NurbsCurve, ClampedEnds_InterpolateTheirControlPoints) {
  Random random(4);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const NurbsCurve curve = RandomCurve(RandomBasis(degree, degree + 4, random), random);
    EXPECT_LT((curve.Evaluate(0) - curve.control_points().front()).norm(), 1e-14);
    EXPECT_LT((curve.Evaluate(1) - curve.control_points().back()).norm(), 1e-14);
  }
}

TEST(NurbsCurve, Periodic_IsSmoothAcrossTheSeam) {
  Random random(5);
  for (int degree = 3; degree <= 6; ++degree) {
    const NurbsCurve curve = RandomCurve(PeriodicUniformBasis(degree, degree + 4, -1, 2), random);
    const NurbsCurve open = Clamped(curve);
    const CurvePoint begin = curve.EvaluateWithDerivatives(-1), end = open.EvaluateWithDerivatives(2);
    EXPECT_LT((begin.position - end.position).norm(), 1e-13);
    EXPECT_LT((begin.d1 - end.d1).norm(), 1e-11);
    EXPECT_LT((begin.d2 - end.d2).norm(), 1e-9);
    EXPECT_LT((curve.Evaluate(0.3) - curve.Evaluate(3.3)).norm(), 1e-13);
  }
}

TEST(NurbsSurface, Derivatives_MatchCentralDifferences) {
  Random random(6);
  const NurbsSurface s = RandomSurface(UniformBasis(4, 8), UniformBasis(3, 7, 0, 2), random);
  const double h = 1e-4;
  for (int trial = 0; trial < 100; ++trial) {
    // Away from knots, where third derivatives jump.
    const double u = (static_cast<double>(random.Below(4)) + random.Uniform(0.1, 0.9)) / 4;
    const double v = (static_cast<double>(random.Below(4)) + random.Uniform(0.1, 0.9)) / 2;
    const SurfacePoint p = s.EvaluateWithDerivatives(u, v);
    const auto at = [&](double a, double b) { return s.Evaluate(u + a * h, v + b * h); };
    EXPECT_LT(((at(1, 0) - at(-1, 0)) / (2 * h) - p.du).norm(), 1e-4);
    EXPECT_LT(((at(0, 1) - at(0, -1)) / (2 * h) - p.dv).norm(), 1e-4);
    EXPECT_LT(((at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / (h * h) - p.duu).norm(), 1e-3 * (1 + p.duu.norm()));
    EXPECT_LT(((at(0, 1) - 2 * at(0, 0) + at(0, -1)) / (h * h) - p.dvv).norm(), 1e-3 * (1 + p.dvv.norm()));
    EXPECT_LT(((at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * h) - p.duv).norm(),
              1e-3 * (1 + p.duv.norm()));
  }
}

TEST(NurbsSurface, SphereCylinderTorus_HaveTheirRadiiAndNormals) {
  const NurbsSurface sphere = ExactSphere(3), cylinder = ExactCylinder(2, 5), torus = ExactTorus(4, 1);
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const double u = random.Uniform(), v = random.Uniform();
    const SurfacePoint a = sphere.EvaluateWithDerivatives(u, v);
    EXPECT_NEAR(a.position.norm(), 3, 1e-13);
    EXPECT_LT((a.Normal() - a.position / 3).norm(), 1e-9);
    const SurfacePoint b = cylinder.EvaluateWithDerivatives(u, v);
    const Eigen::Vector3d radial(b.position.x(), b.position.y(), 0);
    EXPECT_LT((b.Normal() - radial / 2).norm(), 1e-12);
    const SurfacePoint c = torus.EvaluateWithDerivatives(u, v);
    const Eigen::Vector3d centre = 4 * Eigen::Vector3d(c.position.x(), c.position.y(), 0).normalized();
    EXPECT_NEAR((c.position - centre).norm(), 1, 1e-13);
    EXPECT_LT((c.Normal() - (c.position - centre)).norm(), 1e-11);
  }
  EXPECT_TRUE(sphere.EvaluateWithDerivatives(0.3, 1).Normal().isZero(0));  // the pole
}

TEST(NurbsSurface, AffineMap_OfTheNetMapsTheSurface) {
  Random random(8);
  const NurbsSurface s = RandomSurface(UniformBasis(3, 6), PeriodicUniformBasis(2, 5), random);
  Eigen::Affine3d map;
  map.linear() << 2, 0.3, 0, -1, 1, 0.2, 0.1, 0, 0.7;
  map.translation() << 5, -3, 1;
  const NurbsSurface mapped = Transformed(s, map);
  for (int trial = 0; trial < 100; ++trial) {
    const double u = random.Uniform(), v = random.Uniform();
    EXPECT_LT((mapped.Evaluate(u, v) - map * s.Evaluate(u, v)).norm(), 1e-13);
  }
}

TEST(NurbsSurface, PeriodicDirections_AreSmoothAcrossTheSeam) {
  Random random(9);
  const NurbsSurface s = RandomSurface(PeriodicUniformBasis(3, 6), PeriodicUniformBasis(4, 7, 1, 3), random);
  const NurbsSurface open = Clamped(Clamped(s, Direction::kU), Direction::kV);
  for (int trial = 0; trial < 50; ++trial) {
    const double u = random.Uniform(), v = random.Uniform(1, 3);
    for (const auto& [low, high] : {std::pair(Eigen::Vector2d(0, v), Eigen::Vector2d(1, v)),
                                    std::pair(Eigen::Vector2d(u, 1), Eigen::Vector2d(u, 3))}) {
      const SurfacePoint a = s.EvaluateWithDerivatives(low.x(), low.y());
      const SurfacePoint b = open.EvaluateWithDerivatives(high.x(), high.y());
      EXPECT_LT((a.position - b.position).norm(), 1e-13);
      EXPECT_LT((a.du - b.du).norm() + (a.dv - b.dv).norm(), 1e-11);
      EXPECT_LT((a.duu - b.duu).norm() + (a.duv - b.duv).norm() + (a.dvv - b.dvv).norm(), 1e-9);
    }
  }
}

TEST(NurbsSurface, BadInput_IsRefusedByName) {
  const BSplineBasis basis = UniformBasis(1, 2);
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const auto message = [&](std::vector<Eigen::Vector3d> net, std::vector<double> weights) {
    return MessageOf<InputError>([&] { NurbsSurface(basis, basis, net, weights); });
  };
  EXPECT_EQ(message({{0, 0, 0}}, {}),
            "the knot vectors ask for 2 x 2 control points and weights, not 1 and 4");
  EXPECT_EQ(message(points, {1, 1, 0, 1}), "weight 2 is not a positive number");
  EXPECT_EQ(message(points, {1, 1, 1, std::nan("")}), "weight 3 is not a positive number");
  std::vector<Eigen::Vector3d> infinite = points;
  infinite[1].x() = INFINITY;
  EXPECT_EQ(message(infinite, {}), "control point 1 is not finite");
  const std::vector<Eigen::Vector3d> open = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
  EXPECT_EQ(MessageOf<InputError>([&] { NurbsCurve(PeriodicUniformBasis(2, 3), open); }),
            "a periodic curve's last control points do not repeat its first ones");
}

TEST(InsideTrim, FollowsTheEvenOddRule) {
  const std::vector<TrimLoop> ring = {RegularLoop({0.5, 0.5}, 0.4, 64), RegularLoop({0.5, 0.5}, 0.2, 64)};
  EXPECT_TRUE(InsideTrim({}, {7, 7}));
  EXPECT_FALSE(InsideTrim(ring, {0.5, 0.5}));
  EXPECT_TRUE(InsideTrim(ring, {0.5, 0.8}));
  EXPECT_FALSE(InsideTrim(ring, {0.95, 0.5}));
}

}  // namespace
}  // namespace frond
