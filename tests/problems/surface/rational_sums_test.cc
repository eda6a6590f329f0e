// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/rational_sums.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/random.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

// Eq. (25) for a plane or space curve, written out: what a curve fit would hand in.
RationalSums SumsOf(const NurbsCurve& curve, int points) {
  const BSplineBasis& basis = curve.basis();
  const int n = basis.num_control_points(), p = basis.degree();
  RationalSums sums(n);
  std::vector<double> values(static_cast<std::size_t>(p) + 1);
  for (int i = 0; i < points; ++i) {
    const double t = basis.begin() + (basis.end() - basis.begin()) * i / (points - 1);
    const int span = basis.FindSpan(t);
    basis.Evaluate(span, t, 0, values.data());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    for (int k = 0; k <= p; ++k) b[span - p + k] = values[static_cast<std::size_t>(k)];
    const Eigen::Vector3d q = curve.Evaluate(t);
    sums.gram += b * b.transpose();
    for (Eigen::Index c = 0; c < 3; ++c) sums.moment[static_cast<std::size_t>(c)] += q[c] * b * b.transpose();
    sums.square += q.squaredNorm() * b * b.transpose();
  }
  return sums;
}

TEST(RationalSums, PointsOfACurveOfTheSameForm_GiveItsWeightsAndControlPoints) {
  Random random(5);
  for (int trial = 0; trial < 5; ++trial) {
    const NurbsCurve truth = RandomCurve(UniformBasis(3, 8), random);
    const RationalSolution found = SolveRationalSums(SumsOf(truth, 200));
    double mean = 0;
    for (const double w : truth.weights()) mean += w / 8;
    EXPECT_FALSE(found.bounded);
    for (Eigen::Index k = 0; k < 8; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(found.weights[k], truth.weights()[i] / mean, 1e-6);
      EXPECT_LT((found.points.row(k).transpose() - truth.control_points()[i]).norm(), 1e-6);
    }
  }
}

TEST(RationalSums, QuarterOfACircle_HasTheTextbooksWeights) {
  const BSplineBasis basis(2, {0, 0, 0, 1, 1, 1});
  const NurbsCurve arc(basis, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, kHalfRoot, 1});
  const RationalSolution found = SolveRationalSums(SumsOf(arc, 50));
  EXPECT_NEAR(found.weights[1] / found.weights[0], kHalfRoot, 1e-9);
  EXPECT_NEAR(found.weights[2] / found.weights[0], 1, 1e-9);
}

TEST(RationalSums, PolynomialPointsWithSurplusFreedom_GetEqualWeights) {
  // On a straight line many weights fit (numerator and denominator times any quadratic): equal ones are
  // chosen.
  const NurbsCurve line(BSplineBasis(2, {0, 0, 0, 1, 1, 1}), {{0, 0, 0}, {1, 2, 0}, {2, 4, 0}});
  const RationalSolution found = SolveRationalSums(SumsOf(line, 50));
  for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(found.weights[k], 1, 1e-6);
}

TEST(RationalSums, FewerPointsThanFunctions_AreRefused) {
  Random random(1);
  EXPECT_THROW(SolveRationalSums(SumsOf(RandomCurve(UniformBasis(3, 8), random), 5)), FitError);
}

double Quotient(const Eigen::MatrixXd& m, const Eigen::VectorXd& w) { return w.dot(m * w) / w.squaredNorm(); }

TEST(BoundedRayleighMinimum, StaysInTheConeAndIsBelowAllOfADenseGrid) {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix3d a;
    for (Eigen::Index k = 0; k < 9; ++k) a(k / 3, k % 3) = random.Normal();
    const Eigen::Matrix3d m = a * a.transpose();
    const Eigen::VectorXd found = BoundedRayleighMinimum(m);
    ASSERT_GE(found.minCoeff(), kLeastWeight * found.mean() * (1 - 1e-9));
    double least = Quotient(m, Eigen::Vector3d::Ones());
    constexpr int kSide = 200;
    for (int i = 0; i <= kSide; ++i) {
      for (int j = 0; i + j <= kSide; ++j) {  // weights of sum 1 in the cone
        const double free = 1 - kLeastWeight;
        const Eigen::Vector3d w =
            Eigen::Vector3d::Constant(kLeastWeight / 3) + free / kSide * Eigen::Vector3d(i, j, kSide - i - j);
        least = std::min(least, Quotient(m, w));
      }
    }
    // A local minimum of a quotient that is not convex; from equal weights it is the best one here.
    EXPECT_LE(Quotient(m, found), least * (1 + 1e-3) + 1e-12) << trial;
  }
}

TEST(BoundedRayleighMinimum, WhereTheEigenvectorIsPositive_IsThatVector) {
  const Eigen::Vector3d w = Eigen::Vector3d(1, 2, 1.5).normalized();
  const Eigen::Matrix3d m = Eigen::Matrix3d::Identity() - 0.9 * w * w.transpose();
  EXPECT_LT((BoundedRayleighMinimum(m) - w).norm(), 1e-5);
}

}  // namespace
}  // namespace frond
