// SPDX-License-Identifier: BSD-3-Clause
#include "models/bspline_basis.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

TEST(BSplineBasis, Example2_3And2_4_OfTheNurbsBook) {
  const BSplineBasis basis(2, {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5});
  ASSERT_EQ(basis.FindSpan(2.5), 4);
  double n[9];
  basis.Evaluate(4, 2.5, 2, n);
  const double expected[9] = {1.0 / 8, 6.0 / 8, 1.0 / 8, -0.5, 0, 0.5, 1, -2, 1};
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(n[k], expected[k], 1e-15) << k;
}

TEST(BSplineBasis, Functions_OfEveryDegree_AreAPartitionOfUnity) {
  Random random(1);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    for (int trial = 0; trial < 20; ++trial) {
      const BSplineBasis basis =
          RandomBasis(degree, degree + 1 + static_cast<int>(random.Below(12)), random, -2, 3);
      for (int k = 0; k <= 20; ++k) {
        const double t = k == 20 ? 3.0 : random.Uniform(-2, 3);
        double n[3 * (kMaxDegree + 1)];
        basis.Evaluate(basis.FindSpan(t), t, 2, n);
        double sum = 0, slope = 0, steepest = 0;
        for (int i = 0; i <= degree; ++i) {
          EXPECT_GE(n[i], -1e-15);
          sum += n[i];
          slope += n[degree + 1 + i];
          steepest = std::max(steepest, std::abs(n[degree + 1 + i]));
        }
        EXPECT_NEAR(sum, 1, 1e-13);
        EXPECT_NEAR(slope, 0, 1e-12 * (1 + steepest));
      }
    }
  }
}

TEST(BSplineBasis, Derivatives_MatchAutomaticOnes) {
  using Jet = ceres::Jet<double, 1>;
  Random random(2);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const BSplineBasis basis = RandomBasis(degree, degree + 6, random);
    for (int trial = 0; trial < 20; ++trial) {
      const double t = random.Uniform();
      const int span = basis.FindSpan(t);
      double n[3 * (kMaxDegree + 1)];
      Jet jets[2 * (kMaxDegree + 1)];
      basis.Evaluate(span, t, 2, n);
      basis.Evaluate(span, Jet(t, 0), 1, jets);
      for (int k = 0; k < 2 * (degree + 1); ++k) {
        const double derivative = n[degree + 1 + k];
        EXPECT_NEAR(jets[k].v[0], derivative, 1e-9 * (1 + std::abs(derivative))) << "degree " << degree;
      }
    }
  }
}

TEST(BSplineBasis, FindSpan_AtKnotsAndEnds_GivesTheNonEmptySpan) {
  const BSplineBasis basis(2, {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5});
  EXPECT_EQ(basis.FindSpan(-1), 2);
  EXPECT_EQ(basis.FindSpan(0), 2);
  EXPECT_EQ(basis.FindSpan(1), 3);
  EXPECT_EQ(basis.FindSpan(4), 7);
  EXPECT_EQ(basis.FindSpan(5), 7);
  EXPECT_EQ(basis.spans(), (std::vector<int>{2, 3, 4, 5, 7}));
}

TEST(BSplineBasis, IntoDomain_WrapsPeriodicAndClampsOpen) {
  const BSplineBasis periodic = PeriodicUniformBasis(3, 6, 2, 5);
  EXPECT_NEAR(periodic.IntoDomain(5.5), 2.5, 1e-15);
  EXPECT_NEAR(periodic.IntoDomain(-1.5), 4.5, 1e-15);
  EXPECT_EQ(periodic.IntoDomain(5), 2);
  EXPECT_EQ(UniformBasis(3, 6, 2, 5).IntoDomain(5.5), 5);
  EXPECT_EQ(UniformBasis(3, 6, 2, 5).IntoDomain(-1.5), 2);
}

TEST(BSplineBasis, PeriodicKnots_RepeatWithTheDomain) {
  const BSplineBasis basis = PeriodicUniformBasis(2, 3, 0, 1);  // the fewest: 3 distinct, 5 in all
  EXPECT_EQ(basis.num_control_points(), 5);
  EXPECT_EQ(basis.num_distinct_control_points(), 3);
  EXPECT_EQ(basis.begin(), 0);
  EXPECT_EQ(basis.end(), 1);
  std::vector<double> shaken = basis.knots();
  shaken[0] += 1e-11;
  EXPECT_EQ(BSplineBasis(2, shaken, true).knots(), basis.knots());
}

TEST(BSplineBasis, BadKnots_AreRefusedByTheRuleTheyBreak) {
  const auto message = [](int degree, std::vector<double> knots, bool periodic = false) {
    return MessageOf<InputError>([&] { BSplineBasis(degree, std::move(knots), periodic); });
  };
  EXPECT_EQ(message(0, {0, 1}), "degree 0 is outside [1, 12]");
  EXPECT_EQ(message(13, {0, 1}), "degree 13 is outside [1, 12]");
  EXPECT_EQ(message(2, {0, 0, 1, 1}), "a knot vector of degree 2 needs at least 6 knots, not 4");
  EXPECT_EQ(message(1, {0, 0, std::nan(""), 1, 1}), "knot 2 is not finite");
  EXPECT_EQ(message(1, {0, 0, 0.6, 0.5, 1, 1}), "knot 3 decreases");
  EXPECT_EQ(message(1, {0, 0, 0, 0}), "the knot vector's domain is empty");
  EXPECT_EQ(message(2, {0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1}), "knot 3 has a multiplicity above the degree");
  EXPECT_EQ(
      message(2, {-2, -1, 0, 1, 2, 3, 4}, true),
      "a periodic direction of degree 2 needs at least 3 distinct control points (5 with the repeated ones), "
      "not 4 with the repeated ones");
  EXPECT_EQ(message(2, {-2, -1, 0, 1, 2, 3, 4, 5.5}, true),
            "the knots of a periodic direction do not repeat with the domain's length");
}

}  // namespace
}  // namespace frond
