// SPDX-License-Identifier: BSD-3-Clause
#include "models/knot_vector.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

// The NURBS Book, example 9.1.
const std::vector<Eigen::Vector3d> kExample = {{0, 0, 0}, {3, 4, 0}, {-1, 4, 0}, {-4, 0, 0}, {-4, -3, 0}};

void ExpectNear(const std::vector<double>& actual, const std::vector<double>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-15) << i;
}

TEST(KnotVector, ChordParametersAndKnots_OfExample9_1) {
  const auto parameters = Parametrise(kExample, Parametrisation::kChord);
  ExpectNear(parameters, {0, 5.0 / 17, 9.0 / 17, 14.0 / 17, 1});
  ExpectNear(InterpolationBasis(3, parameters).knots(), {0, 0, 0, 0, 28.0 / 51, 1, 1, 1, 1});
}

TEST(KnotVector, UniformAndCentripetalParameters_FollowTheirEquations) {
  ExpectNear(Parametrise(kExample, Parametrisation::kUniform), {0, 0.25, 0.5, 0.75, 1});
  const double total = 2 * std::sqrt(5.0) + 2 + std::sqrt(3.0);
  ExpectNear(Parametrise(kExample, Parametrisation::kCentripetal),
             {0, std::sqrt(5.0) / total, (std::sqrt(5.0) + 2) / total, (2 * std::sqrt(5.0) + 2) / total, 1});
}

TEST(KnotVector, ApproximationKnots_FollowEquation9_69) {
  // m + 1 = 7 parameters, n + 1 = 5 control points, p = 2: d = 7/3; jd = 2 + 1/3 and 4 + 2/3.
  const std::vector<double> t = {0, 0.1, 0.25, 0.4, 0.7, 0.9, 1};
  ExpectNear(ApproximationBasis(2, 5, t).knots(),
             {0, 0, 0, 2.0 / 3 * 0.1 + 1.0 / 3 * 0.25, 1.0 / 3 * 0.4 + 2.0 / 3 * 0.7, 1, 1, 1});
}

TEST(KnotVector, ApproximationKnots_LeaveAParameterInEverySpan) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const int degree = 1 + static_cast<int>(random.Below(5));
    const int count = degree + 1 + static_cast<int>(random.Below(20));
    std::vector<double> t{0, 1};
    while (static_cast<int>(t.size()) < count + static_cast<int>(random.Below(30)))
      t.push_back(random.Uniform());
    std::sort(t.begin(), t.end());
    if (static_cast<int>(t.size()) < count) continue;
    const BSplineBasis basis = ApproximationBasis(degree, count, t);
    for (const int s : basis.spans()) {
      const double a = basis.knots()[static_cast<std::size_t>(s)],
                   b = basis.knots()[static_cast<std::size_t>(s) + 1];
      EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](double x) { return x >= a && x <= b; }));
    }
  }
}

TEST(KnotVector, UniformBases_HaveEvenSpansOnTheirDomain) {
  ExpectNear(UniformBasis(2, 5, 1, 4).knots(), {1, 1, 1, 2, 3, 4, 4, 4});
  ExpectNear(PeriodicUniformBasis(2, 3, 1, 4).knots(), {-1, 0, 1, 2, 3, 4, 5, 6});
}

TEST(KnotVector, BadInput_IsRefusedByName) {
  const std::vector<Eigen::Vector3d> same(4, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(MessageOf<InputError>([&] { Parametrise(same, Parametrisation::kChord); }),
            "a row of points without length has no chord or centripetal parameters");
  EXPECT_NO_THROW(Parametrise(same, Parametrisation::kUniform));
  const std::vector<double> t = {0, 0.5, 1};
  EXPECT_EQ(MessageOf<InputError>([&] { ApproximationBasis(2, 4, t); }),
            "4 control points are more than the 3 points to approximate");
  EXPECT_EQ(MessageOf<InputError>([&] { InterpolationBasis(3, t); }),
            "degree 3 needs at least 4 points to interpolate, not 3");
  EXPECT_EQ(MessageOf<InputError>([&] { UniformBasis(3, 3); }),
            "degree 3 needs at least 4 control points, not 3");
  EXPECT_EQ(MessageOf<InputError>([&] { PeriodicUniformBasis(3, 3); }),
            "degree 3 needs at least 4 distinct control points in a periodic direction, not 3");
}

}  // namespace
}  // namespace frond
