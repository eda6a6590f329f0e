// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/curve_foot_point.h"
#include "problems/curve/curve_errors.h"
#include "tests/problems/curve/curve_cases.h"

namespace frond {
namespace {

double ErrorAgainst(const Points& truth, const NurbsCurve& curve) {
  const CurveSpans spans(curve);
  const CurveFootSearch search(spans);
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : truth)
    distances.push_back(std::sqrt(search.Find(point).squared_distance));
  return RootMeanSquare(distances);
}

CurveFitOptions ClosedOptions(int control_points) {
  CurveFitOptions options;
  options.closed = true;
  options.control_points = control_points;
  return options;
}

TEST(FitCurve, ClosedNoisyOutline_IsNearerToTheTruthThanThePoints) {
  const Points noisy = WithNoise(OutlinePoints(600), 0.05, 1, true);
  const CurveFit fit = Fitted(noisy, ClosedOptions(24));
  EXPECT_TRUE(fit.closed());
  EXPECT_NEAR(RootMeanSquare(fit.distances), 0.05, 0.005);
  EXPECT_LT(ErrorAgainst(OutlinePoints(1000), fit.curve), 0.02);
  for (const Eigen::Vector3d& point : fit.curve.control_points()) EXPECT_EQ(point.z(), 0);
}

TEST(FitCurve, CurveInSpace_OpenAndClosed) {
  CurveFitOptions open;
  const CurveFit helix = Fitted(WithNoise(HelixPoints(500), 0.02, 2, false), open);
  EXPECT_LT(ErrorAgainst(HelixPoints(1000), helix.curve), 0.01);
  const CurveFit loop = Fitted(WithNoise(OutlinePoints(600, 3), 0.02, 3, false), ClosedOptions(28));
  EXPECT_LT(ErrorAgainst(OutlinePoints(1000, 3), loop.curve), 0.01);
}

// Degree 2 with free weights has double knots, which open curves have with odd numbers only.
TEST(FitCurve, ChosenNumberOfControlPoints_GrowsWithConicsToo) {
  CurveFitOptions options;
  options.degree = 2;
  options.control_points = 0;
  options.closed = false;
  options.unknowns = CurveUnknowns::kBoth;
  const CurveFit fit = Fitted(HelixPoints(200, 2), options);
  EXPECT_GE(fit.curve.basis().num_control_points(), 7);
  EXPECT_EQ(fit.curve.basis().num_control_points() % 2, 1);
  EXPECT_LT(RootMeanSquare(fit.distances), 0.05);
}

// Multiplicity 2 comes to an odd number on an open curve, to an even one on a closed one.
TEST(FitCurve, ClosedAuto_TakesTheNumbersOfTheCurveItFinds) {
  CurveFitOptions options;
  options.degree = 2;
  options.knot_multiplicity = 2;
  options.closed = std::nullopt;
  options.control_points = 7;
  EXPECT_FALSE(Fitted(EllipsePoints(60, 4, 4, 0, 3), options).closed());
  options.control_points = 8;
  EXPECT_TRUE(Fitted(EllipsePoints(60, 4, 4, 0, 2 * std::numbers::pi), options).closed());
}

// A budget for the first pass alone: its curve is kept, not the start of the next.
TEST(FitCurve, SpentBudget_KeepsTheCurveOfThePassBefore) {
  CurveFitOptions options;
  options.unknowns = CurveUnknowns::kBoth;
  options.control_points = 10;
  options.closed = false;
  const Points points = WithNoise(HelixPoints(200, 2), 0.01, 1, false);
  CurveFitOptions first_pass = options;
  first_pass.fairness = 0;
  const CurveFit free = Fitted(points, first_pass);
  Budget budget;
  for (const std::int64_t more : {0, 1}) {
    budget.max_evaluations = free.report.evaluations + more;
    const CurveFit spent = Fitted(points, options, 1, budget);
    EXPECT_NEAR(RootMeanSquare(spent.distances), RootMeanSquare(free.distances), 1e-9) << more;
  }
}

// The distance fit needs fewer control points than the fit at fixed parameters.
TEST(FitCurve, OrthogonalDistances_AreLessThanParametricOnes) {
  CurveFitOptions options = ClosedOptions(16);
  const Points points = OutlinePoints(400);
  const CurveFit orthogonal = Fitted(points, options);
  options.distance = CurveDistance::kParametric;
  const CurveFit parametric = Fitted(points, options);
  EXPECT_LT(RootMeanSquare(orthogonal.distances), 0.7 * RootMeanSquare(parametric.distances));
}

TEST(FitCurve, UnorderedNoisyPoints_GiveTheCurveOfTheOrderedOnes) {
  CurveFitOptions options = ClosedOptions(24);
  options.order = CurveOrder::kFind;
  options.closed = std::nullopt;
  const CurveFit closed = Fitted(Shuffled(WithNoise(OutlinePoints(800), 0.1, 4, true), 5), options);
  EXPECT_TRUE(closed.closed());
  EXPECT_LT(ErrorAgainst(OutlinePoints(1000), closed.curve), 0.03);
  options.control_points = 16;
  const CurveFit open = Fitted(Shuffled(WithNoise(HelixPoints(800), 0.1, 6, false), 7), options);
  EXPECT_FALSE(open.closed());
  EXPECT_LT(ErrorAgainst(HelixPoints(1000), open.curve), 0.03);
}

TEST(FitCurve, EveryParametrisationAndKnots_FitTheOutline) {
  const Points points = OutlinePoints(300);
  for (const auto parametrisation : {CurveParametrisation::kUniform, CurveParametrisation::kChord,
                                     CurveParametrisation::kCentripetal, CurveParametrisation::kBaseCurve}) {
    for (const auto knots :
         {CurveKnots::kUniform, CurveKnots::kAveraging, CurveKnots::kMa, CurveKnots::kRefine}) {
      for (const bool closed : {false, true}) {
        SCOPED_TRACE(std::to_string(static_cast<int>(parametrisation)) +
                     std::to_string(static_cast<int>(knots)) + (closed ? " closed" : " open"));
        CurveFitOptions options = ClosedOptions(28);
        options.closed = closed;
        options.parametrisation = parametrisation;
        options.knots = knots;
        const CurveFit fit = Fitted(points, options);
        EXPECT_LT(RootMeanSquare(fit.distances), 0.05)
            << static_cast<int>(parametrisation) << " " << static_cast<int>(knots) << closed;
        EXPECT_EQ(fit.curve.basis().num_distinct_control_points(), 28);
      }
    }
  }
}

TEST(FitCurve, BaseCircleAndLine_OrderPointsByThemselves) {
  CurveFitOptions options = ClosedOptions(24);
  options.order = CurveOrder::kFind;
  options.parametrisation = CurveParametrisation::kBaseCurve;
  options.base = BaseCurve::kCircle;
  EXPECT_LT(RootMeanSquare(Fitted(Shuffled(OutlinePoints(400), 8), options).distances), 0.03);
  options.closed = false;
  options.base = BaseCurve::kLine;
  options.control_points = 24;
  Points wave;
  for (int i = 0; i < 300; ++i) wave.emplace_back(0.1 * i, 2 * std::sin(0.3 * i / 3), 0);
  EXPECT_LT(RootMeanSquare(Fitted(Shuffled(wave, 9), options).distances), 0.05);
}

TEST(FitCurve, Refinement_StopsAtTheTolerance) {
  CurveFitOptions options = ClosedOptions(80);
  options.knots = CurveKnots::kRefine;
  options.tolerance = 0.02;
  const CurveFit fit = Fitted(OutlinePoints(500), options);
  EXPECT_LE(Largest(fit.distances), 0.02);
  EXPECT_LT(fit.curve.basis().num_distinct_control_points(), 60);
}

TEST(FitCurve, HeldOutError_ChoosesTheNumberOfControlPoints) {
  CurveFitOptions options = ClosedOptions(0);
  const CurveFit fit = Fitted(WithNoise(OutlinePoints(500), 0.1, 10, true), options);
  EXPECT_GE(fit.curve.basis().num_distinct_control_points(), 14);
  EXPECT_LE(fit.curve.basis().num_distinct_control_points(), 28);
  options.degree = 2;
  options.unknowns = CurveUnknowns::kBoth;
  const CurveFit circle = Fitted(EllipsePoints(100, 5, 5, 0, 2 * std::numbers::pi), options);
  EXPECT_EQ(circle.curve.basis().num_distinct_control_points(), 6);
}

TEST(FitCurve, AsManyControlPointsAsPoints_Interpolates) {
  CurveFitOptions options;
  options.distance = CurveDistance::kParametric;
  for (const bool closed : {false, true}) {
    for (const int degree : {2, 3}) {
      options.closed = closed;
      options.degree = degree;
      options.control_points = 15;
      const CurveFit fit = Fitted(OutlinePoints(15), options);
      EXPECT_LT(MeasureCurveErrors(OutlinePoints(15), fit).parametric_total, 1e-9) << closed << degree;
    }
  }
}

// With free weights eq. (22) starts from Ma's two steps and ends below the fit with fixed ones.
TEST(FitCurve, FreeWeights_LowerTheParametricError) {
  CurveFitOptions options = ClosedOptions(14);
  options.distance = CurveDistance::kParametric;
  const double fixed =
      MeasureCurveErrors(OutlinePoints(300), Fitted(OutlinePoints(300), options)).parametric_total;
  options.unknowns = CurveUnknowns::kBoth;
  const CurveFit fit = Fitted(OutlinePoints(300), options);
  EXPECT_LT(MeasureCurveErrors(OutlinePoints(300), fit).parametric_total, 0.9 * fixed);
  options.unknowns = CurveUnknowns::kWeights;
  EXPECT_LT(MeasureCurveErrors(OutlinePoints(300), Fitted(OutlinePoints(300), options)).parametric_total,
            fixed);
}

TEST(FitCurve, FreeWeightsOnNoise_StayModerate) {
  CurveFitOptions options = ClosedOptions(24);
  options.unknowns = CurveUnknowns::kBoth;
  const CurveFit fit = Fitted(WithNoise(OutlinePoints(600), 0.05, 1, true), options);
  EXPECT_LT(ErrorAgainst(OutlinePoints(1000), fit.curve), 0.02);
  EXPECT_LT(Largest(fit.curve.weights()), 20);
}

// Distances alone would let the curve run back along itself.
TEST(FitCurve, NoisySpiralInAnyOrder_IsNotLongerThanTheSpiral) {
  Points spiral;
  double length = 0;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 4 * std::numbers::pi * std::sqrt(i / 1999.0);
    spiral.emplace_back((1 + angle) * std::cos(angle), (1 + angle) * std::sin(angle), 0);
    if (i > 0) length += (spiral[spiral.size() - 1] - spiral[spiral.size() - 2]).norm();
  }
  CurveFitOptions options;
  options.control_points = 24;
  options.closed = std::nullopt;
  options.order = CurveOrder::kFind;
  const CurveFit fit = Fitted(Shuffled(WithNoise(spiral, 0.1, 1, true), 2), options);
  EXPECT_FALSE(fit.closed());
  EXPECT_NEAR(IntegrateCurve(CurveSpans(fit.curve)).length, length, 0.02 * length);
  EXPECT_LT(ErrorAgainst(spiral, fit.curve), 0.03);
}

TEST(FitCurve, MotionAndUnit_ChangeNothing) {
  const Points points = WithNoise(OutlinePoints(300, 2), 0.05, 11, false);
  const Eigen::AngleAxisd turn(1, Eigen::Vector3d(1, 2, 3).normalized());
  Points moved;
  for (const Eigen::Vector3d& point : points)
    moved.push_back(1000 * (turn * point) + Eigen::Vector3d(1e5, 2e5, -3e5));
  const CurveFit fit = Fitted(points, ClosedOptions(20)), same = Fitted(moved, ClosedOptions(20));
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_NEAR(same.distances[i], 1000 * fit.distances[i], 0.3) << i;
  }
}

TEST(FitCurve, Threads_ChangeNoBit) {
  const Points points = WithNoise(OutlinePoints(3000), 0.05, 12, true);
  const CurveFit one = Fitted(points, ClosedOptions(20), 1), four = Fitted(points, ClosedOptions(20), 4);
  EXPECT_EQ(one.curve.control_points(), four.curve.control_points());
  EXPECT_EQ(one.distances, four.distances);
}

TEST(FitCurve, TenThousandPoints_TakeLessThanASecond) {
  const Points points = WithNoise(OutlinePoints(10000), 0.05, 13, true);
  for (const auto order : {CurveOrder::kGiven, CurveOrder::kFind}) {
    CurveFitOptions options = ClosedOptions(24);
    options.order = order;
    const auto begin = std::chrono::steady_clock::now();
    const CurveFit fit = Fitted(points, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(seconds, 5) << "of a debug build on a busy machine";
    EXPECT_LT(ErrorAgainst(OutlinePoints(1000), fit.curve), 0.01);
  }
}

template <typename Error>
void ExpectRefused(const Points& points, const CurveFitOptions& options, const std::string& part) {
  try {
    Fitted(points, options);
    ADD_FAILURE() << "no error with '" << part << "'";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(FitCurve, UnusableInput_IsRefusedInOneLine) {
  CurveFitOptions options;
  ExpectRefused<InputError>(HelixPoints(12), options, "12 points, fewer than the 20 control points");
  ExpectRefused<InputError>(Points(40, Eigen::Vector3d(1, 2, 3)), options, "all points coincide");
  Points few = HelixPoints(10);
  few.insert(few.end(), 30, few.back());
  ExpectRefused<InputError>(few, options, "10 different places");
  options.control_points = 3;
  ExpectRefused<InputError>(HelixPoints(12), options, "degree 3 needs at least 4");
  options.closed = true;
  ExpectRefused<InputError>(OutlinePoints(3), options,
                            "3 points, fewer than the 4 control points of the closed");
  options.control_points = 7;
  options.knot_multiplicity = 2;
  ExpectRefused<InputError>(OutlinePoints(30), options, "take 8");
}

}  // namespace
}  // namespace frond
