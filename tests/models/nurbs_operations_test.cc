// SPDX-License-Identifier: BSD-3-Clause
#include "models/nurbs_operations.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

double Difference(const NurbsCurve& a, const NurbsCurve& b) {
  double most = 0;
  for (int k = 0; k <= 300; ++k) {
    const double t = b.basis().begin() + (b.basis().end() - b.basis().begin()) * k / 300;
    most = std::max(most, (a.Evaluate(t) - b.Evaluate(t)).norm());
  }
  return most;
}

double Difference(const NurbsSurface& a, const NurbsSurface& b) {
  double most = 0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      const double u = b.u().begin() + (b.u().end() - b.u().begin()) * i / 40;
      const double v = b.v().begin() + (b.v().end() - b.v().begin()) * j / 40;
      most = std::max(most, (a.Evaluate(u, v) - b.Evaluate(u, v)).norm());
    }
  }
  return most;
}

// Clamped, unclamped and periodic curves of every degree.
std::vector<NurbsCurve> Curves() {
  Random random(11);
  std::vector<NurbsCurve> curves;
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    curves.push_back(RandomCurve(RandomBasis(degree, degree + 7, random), random));
    curves.push_back(RandomCurve(PeriodicUniformBasis(degree, degree + 1 + degree % 3), random));
    std::vector<double> knots;
    for (int k = -degree; k <= 5 + degree; ++k) knots.push_back(k / 5.0 + random.Uniform(0, 0.1));
    curves.push_back(RandomCurve(BSplineBasis(degree, knots), random));
  }
  return curves;
}

TEST(InsertKnots, OneKnot_GivesTheAlphasOfExample5_1) {
  Random random(10);
  const NurbsCurve random_curve = RandomCurve(BSplineBasis(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5}), random);
  const NurbsCurve curve(random_curve.basis(), random_curve.control_points());
  const auto& p = curve.control_points();
  const double knot = 2.5;
  const auto q = InsertKnots(curve, {&knot, 1}).control_points();
  ASSERT_EQ(q.size(), 9u);
  EXPECT_LT((q[2] - p[2]).norm(), 1e-15);
  EXPECT_LT((q[3] - (5.0 / 6 * p[3] + 1.0 / 6 * p[2])).norm(), 1e-15);
  EXPECT_LT((q[4] - (0.5 * p[4] + 0.5 * p[3])).norm(), 1e-15);
  EXPECT_LT((q[5] - (1.0 / 6 * p[5] + 5.0 / 6 * p[4])).norm(), 1e-15);
  EXPECT_LT((q[6] - p[5]).norm(), 1e-15);
}

TEST(InsertKnots, AnyCurve_KeepsItsShape) {
  Random random(12);
  for (const NurbsCurve& curve : Curves()) {
    std::vector<double> knots;
    for (int k = 0; k < 5; ++k) knots.push_back(random.Uniform(curve.basis().begin(), curve.basis().end()));
    if (curve.basis().degree() > 1) knots.push_back(knots[0]);
    const NurbsCurve finer = InsertKnots(curve, knots);
    EXPECT_EQ(finer.basis().num_control_points(),
              curve.basis().num_control_points() + static_cast<int>(knots.size()));
    EXPECT_EQ(finer.basis().periodic(), curve.basis().periodic());
    EXPECT_LT(Difference(curve, finer), 1e-12) << "degree " << curve.basis().degree();
    EXPECT_LT(Difference(curve, Refine(Refine(curve))), 1e-12);
  }
}

TEST(InsertKnots, AtAPeriodicSeam_KeepsTheShape) {
  Random random(13);
  for (int degree = 2; degree <= 5; ++degree) {
    const NurbsCurve curve = RandomCurve(PeriodicUniformBasis(degree, degree + 2, 0.1, 0.7), random);
    for (const double seam : {curve.basis().begin(), curve.basis().end()}) {
      const NurbsCurve finer = InsertKnots(curve, {&seam, 1});
      EXPECT_TRUE(finer.basis().periodic());
      EXPECT_LT(Difference(curve, finer), 1e-13);
      EXPECT_LT(Difference(curve, ElevateDegree(finer)), 1e-12);
    }
  }
}

TEST(ElevateDegree, AnyCurve_KeepsItsShapeAndContinuity) {
  for (const NurbsCurve& curve : Curves()) {
    for (const int by : {0, 1, 3}) {
      if (curve.basis().degree() + by > kMaxDegree) continue;
      const NurbsCurve raised = ElevateDegree(curve, by);
      EXPECT_EQ(raised.basis().degree(), curve.basis().degree() + by);
      EXPECT_EQ(raised.basis().periodic(), curve.basis().periodic());
      EXPECT_EQ(raised.basis().spans().size(), curve.basis().spans().size());
      EXPECT_LT(Difference(curve, raised), 1e-12) << "degree " << curve.basis().degree() << " by " << by;
    }
  }
}

TEST(ElevateDegree, BezierQuadratic_GivesTheTextbookCubic) {
  const NurbsCurve curve(UniformBasis(2, 3), {{0, 0, 0}, {1, 2, 0}, {3, 0, 1}});
  const auto q = ElevateDegree(curve).control_points();
  ASSERT_EQ(q.size(), 4u);
  EXPECT_LT((q[1] - Eigen::Vector3d(2.0 / 3, 4.0 / 3, 0)).norm(), 1e-15);
  EXPECT_LT((q[2] - Eigen::Vector3d(5.0 / 3, 4.0 / 3, 1.0 / 3)).norm(), 1e-15);
}

TEST(Part, AnyCurve_IsClampedAndKeepsItsShape) {
  Random random(14);
  for (const NurbsCurve& curve : Curves()) {
    const double begin = curve.basis().begin(), length = curve.basis().end() - begin;
    const double t = begin + length * random.Uniform(0.2, 0.8);
    const auto [first, second] = Split(curve, t);
    EXPECT_EQ(first.basis().end(), t);
    EXPECT_EQ(second.basis().begin(), t);
    EXPECT_LT((first.control_points().back() - curve.Evaluate(t)).norm(), 1e-12);
    EXPECT_LT((first.control_points().back() - second.control_points().front()).norm(), 1e-14);
    EXPECT_LT(std::max(Difference(curve, first), Difference(curve, second)), 1e-12);
    EXPECT_LT(Difference(curve, Clamped(curve)), 1e-12);
    EXPECT_FALSE(Clamped(curve).basis().periodic());
  }
}

TEST(Part, AtAKnotOfFullMultiplicity_IsExact) {
  const auto [first, second] = Split(ExactCircle(1), 0.5);
  EXPECT_EQ(first.basis().knots(), (std::vector<double>{0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.5}));
  EXPECT_EQ(second.control_points().size(), 5u);
  EXPECT_LT(Difference(ExactCircle(1), second), 1e-15);
}

TEST(Reversed, AnyCurve_RunsBackwards) {
  for (const NurbsCurve& curve : Curves()) {
    const NurbsCurve back = Reversed(curve);
    const double sum = curve.basis().begin() + curve.basis().end();
    EXPECT_EQ(back.basis().begin(), curve.basis().begin());
    EXPECT_EQ(back.basis().end(), curve.basis().end());
    for (int k = 0; k <= 50; ++k) {
      const double t = curve.basis().begin() + (curve.basis().end() - curve.basis().begin()) * k / 50;
      EXPECT_LT((curve.Evaluate(t) - back.Evaluate(sum - t)).norm(), 1e-12);
    }
  }
}

TEST(NurbsOperations, OnSurfaces_KeepTheShape) {
  Random random(15);
  const std::vector<NurbsSurface> surfaces = {
      RandomSurface(RandomBasis(3, 9, random), RandomBasis(2, 6, random), random),
      RandomSurface(PeriodicUniformBasis(3, 5), UniformBasis(4, 7, -1, 4), random),
      RandomSurface(UniformBasis(1, 4), PeriodicUniformBasis(2, 3, 2, 3), random), ExactTorus(3, 1)};
  for (const NurbsSurface& s : surfaces) {
    for (const Direction d : {Direction::kU, Direction::kV}) {
      const BSplineBasis& basis = d == Direction::kU ? s.u() : s.v();
      const double t = basis.begin() + 0.37 * (basis.end() - basis.begin());
      EXPECT_LT(Difference(s, InsertKnots(s, d, {&t, 1})), 1e-12);
      EXPECT_LT(Difference(s, Refine(s, d)), 1e-12);
      EXPECT_LT(Difference(s, ElevateDegree(s, d, 2)), 1e-12);
      EXPECT_LT(Difference(s, Clamped(s, d)), 1e-12);
      const auto [first, second] = Split(s, d, t);
      EXPECT_LT(std::max(Difference(s, first), Difference(s, second)), 1e-12);
      EXPECT_LT(Difference(s, Reversed(Reversed(s, d), d)), 1e-12);
      const NurbsCurve iso = IsoCurve(s, d, t);
      for (int k = 0; k <= 20; ++k) {
        const double other = iso.basis().begin() + (iso.basis().end() - iso.basis().begin()) * k / 20;
        const Eigen::Vector3d point = d == Direction::kU ? s.Evaluate(t, other) : s.Evaluate(other, t);
        EXPECT_LT((iso.Evaluate(other) - point).norm(), 1e-13);
        EXPECT_LE(BoundingBox(s).exteriorDistance(point), 1e-14);
      }
    }
    EXPECT_LT((s.Evaluate(s.u().end() / 3, s.v().end() / 2) -
               Transposed(s).Evaluate(s.v().end() / 2, s.u().end() / 3))
                  .norm(),
              1e-14);
  }
}

TEST(NurbsOperations, BadInput_IsRefusedByName) {
  const NurbsCurve circle = ExactCircle(1);
  const auto insert = [&](double t) { return [&circle, t] { InsertKnots(circle, {&t, 1}); }; };
  EXPECT_EQ(MessageOf<InputError>(insert(0.5)), "knot 0.500000 has the multiplicity 2 of the degree already");
  EXPECT_EQ(MessageOf<InputError>(insert(2)),
            "parameter 2.000000 is outside the domain [0.000000, 1.000000]");
  EXPECT_EQ(MessageOf<InputError>([&] { ElevateDegree(circle, 11); }),
            "degree 2 cannot be raised by 11 (the largest is 12)");
  EXPECT_EQ(MessageOf<InputError>([&] { Split(circle, 1); }),
            "cannot split at 1.000000: not inside the domain (0.000000, 1.000000)");
  EXPECT_EQ(MessageOf<InputError>([&] { Part(circle, 0.5, 0.25); }),
            "a part from 0.500000 to 0.250000 is empty");
}

}  // namespace
}  // namespace frond
