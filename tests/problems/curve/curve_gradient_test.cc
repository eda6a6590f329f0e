// SPDX-License-Identifier: BSD-3-Clause
// Hand-written rows against the definition by auto-diff, and the cost against its gradient.
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/knot_vector.h"
#include "problems/curve/curve_distance_fit.h"
#include "problems/curve/parametric_start.h"
#include "tests/problems/curve/curve_cases.h"

namespace frond {
namespace {

struct Case {
  CurveUnknowns unknowns;
  CurveDistance distance;
  bool closed;
};

struct Evaluation {
  double cost = 0;
  std::vector<double> gradient;
};

Evaluation Evaluate(const CurveDistanceFit& fit, std::span<const double> x) {
  LeastSquares problem(fit, 1);
  problem.SetX(x);
  Evaluation evaluation;
  problem.problem().Evaluate({}, &evaluation.cost, nullptr, &evaluation.gradient, nullptr);
  return evaluation;
}

class CurveGradient : public ::testing::TestWithParam<Case> {};

TEST_P(CurveGradient, OfStructuredRows_IsThatOfAutodiff) {
  const Case& c = GetParam();
  const Points points = WithNoise(c.closed ? OutlinePoints(200, 2) : HelixPoints(200), 0.1, 1, false);
  const std::vector<double> parameters = c.closed ? ParametriseClosed(points, Parametrisation::kChord)
                                                  : Parametrise(points, Parametrisation::kChord);
  const BSplineBasis basis = c.closed ? PeriodicUniformBasis(3, 12) : UniformBasis(3, 12);
  std::vector<double> weights;
  for (int k = 0; k < basis.num_control_points(); ++k) {
    weights.push_back(1 + 0.3 * (k % basis.num_distinct_control_points() % 4));
  }
  const NurbsCurve start = FitCurveAtParameters(points, parameters, basis, 1e-9, weights);
  CurveDistanceOptions options{
      .unknowns = c.unknowns, .distance = c.distance, .fairness = 1e-8, .weight_ridge = 0.1};
  const CurveDistanceFit structured(points, parameters, start, options);
  options.derivatives = CurveDerivatives::kAutodiff;
  const CurveDistanceFit autodiff(points, parameters, start, options);
  const std::vector<double> x = structured.StartVector();
  const Evaluation ours = Evaluate(structured, x), theirs = Evaluate(autodiff, x);
  ASSERT_EQ(ours.gradient.size(), theirs.gradient.size());
  double size = 0;
  for (const double value : theirs.gradient) size = std::max(size, std::abs(value));
  EXPECT_NEAR(ours.cost, theirs.cost, 1e-12 * theirs.cost);
  for (std::size_t k = 0; k < ours.gradient.size(); ++k) {
    EXPECT_NEAR(ours.gradient[k], theirs.gradient[k], 1e-9 * size) << k;
  }
  // Central differences of the cost, feet found anew: the envelope theorem. The gradient does not hold the
  // fixed weight of the first block (of whole constant blocks it does).
  std::size_t entry = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (c.unknowns == CurveUnknowns::kBoth && k == 3) continue;
    std::vector<double> plus = x, minus = x;
    const double step = 1e-5;
    plus[k] += step;
    minus[k] -= step;
    const double slope = (Evaluate(structured, plus).cost - Evaluate(structured, minus).cost) / (2 * step);
    const bool constant = c.unknowns == CurveUnknowns::kWeights && k == 0;
    EXPECT_NEAR(ours.gradient[entry++], constant ? 0 : slope, 1e-5 * size) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CurveGradient,
                         ::testing::Values(Case{CurveUnknowns::kControlPoints, CurveDistance::kOrthogonal,
                                                true},
                                           Case{CurveUnknowns::kBoth, CurveDistance::kOrthogonal, true},
                                           Case{CurveUnknowns::kBoth, CurveDistance::kOrthogonal, false},
                                           Case{CurveUnknowns::kWeights, CurveDistance::kOrthogonal, true},
                                           Case{CurveUnknowns::kBoth, CurveDistance::kParametric, false}));

}  // namespace
}  // namespace frond
