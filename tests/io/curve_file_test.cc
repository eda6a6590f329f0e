// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "base/errors.h"
#include "base/random.h"
#include "io/cad_file.h"
#include "io/curve_json.h"
#include "models/knot_vector.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

struct SampleCurve {
  std::string name;
  NurbsCurve curve;
};

Eigen::Vector3d Wave(double t) { return {40 * std::cos(t), 25 * std::sin(t), 5 * std::sin(3 * t)}; }

NurbsCurve Open(int degree, int count, bool rational) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < count; ++i) {
    points.push_back(Wave(0.37 * i));
    weights.push_back(rational ? 1 + 0.3 * std::sin(i) : 1.0);
  }
  return {UniformBasis(degree, count), points, weights};
}

NurbsCurve Closed(int degree, int count, bool rational) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < count + degree; ++i) {
    const int k = i % count;
    points.push_back(Wave(2 * std::numbers::pi * k / count));
    weights.push_back(rational ? 1 + 0.3 * std::sin(k) : 1.0);
  }
  return {PeriodicUniformBasis(degree, count), points, weights};
}

// x² + y² = 1 to rounding.
NurbsCurve QuarterCircle() {
  return {BSplineBasis(2, {0, 0, 0, 1, 1, 1}), {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, std::sqrt(0.5), 1}};
}

std::vector<SampleCurve> SampleCurves() {
  return {{"Cubic", Open(3, 9, false)},       {"RationalCubic", Open(3, 9, true)},
          {"Polyline", Open(1, 5, false)},    {"HighDegree", Open(7, 12, true)},
          {"Periodic", Closed(3, 11, false)}, {"RationalPeriodic", Closed(2, 8, true)},
          {"QuarterCircle", QuarterCircle()}};
}

bool SameBits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(CurveJson, EveryCurve_ReadsBackToTheBit) {
  const TempFolder folder;
  for (const SampleCurve& sample : SampleCurves()) {
    WriteCurveJson(folder / "curve.json", {sample.curve, "cm"});
    const CurveDocument read = ReadCurveJson(folder / "curve.json");
    const NurbsCurve &a = sample.curve, &b = read.curve;
    EXPECT_EQ(read.unit, "cm");
    EXPECT_EQ(a.basis().degree(), b.basis().degree());
    EXPECT_EQ(a.basis().periodic(), b.basis().periodic());
    EXPECT_TRUE(SameBits(a.basis().knots(), b.basis().knots())) << sample.name;
    EXPECT_TRUE(SameBits(a.weights(), b.weights())) << sample.name;
    EXPECT_TRUE(SameBits({a.control_points()[0].data(), 3 * a.control_points().size()},
                         {b.control_points()[0].data(), 3 * b.control_points().size()}))
        << sample.name;
    EXPECT_EQ(FormatCurveJson(read), FileText(folder / "curve.json"));
  }
}

std::string ErrorAfter(const std::string& from, const std::string& to) {
  std::string text = FormatCurveJson({Open(3, 6, true), "mm"});
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return MessageOf<InputError>([&] { ParseCurveJson(text, "curve.json"); });
}

TEST(CurveJson, BadFiles_AreRefusedWithTheirJsonPath) {
  EXPECT_TRUE(Holds(ErrorAfter("nurbs_curve/1", "nurbs_curve/9"), "curve.json: schema: expected"));
  EXPECT_TRUE(Holds(ErrorAfter("\"mm\"", "\"parsec\""), "curve.json: unit: unknown unit"));
  EXPECT_TRUE(Holds(ErrorAfter("\"degree\": 3", "\"degree\": 0"), "curve.json: degree: is 0"));
  EXPECT_TRUE(
      Holds(ErrorAfter("\"degree\": 3", "\"degree\": 2"), "curve.json: control_points: has 6 values"));
  EXPECT_TRUE(
      Holds(ErrorAfter("\"periodic\": false", "\"periodic\": 1"), "periodic: expected true or false"));
  EXPECT_TRUE(Holds(ErrorAfter("\"periodic\": false", "\"periodic\": true"), "curve.json: knots: "));
  EXPECT_TRUE(Holds(ErrorAfter("\"knots\": [0,", "\"knots\": [\"a\","), "knots[0]: expected a number"));
  EXPECT_TRUE(Holds(ErrorAfter("[40, 0, 0]", "[40, 0]"), "control_points[0]: has 2 values, expected 3"));
  EXPECT_TRUE(Holds(ErrorAfter("[40, 0, 0]", "[40, null, 0]"), "control_points[0][1]: expected a number"));
  EXPECT_TRUE(Holds(ErrorAfter("\"weights\": [1,", "\"weights\": [-1,"), "weights[0]: a weight must be"));
  EXPECT_TRUE(Holds(ErrorAfter("\"weights\"", "\"wights\""), "has no 'weights'"));
}

TEST(CurveCad, EveryCurveInStepAndIges_ReadsBackTo1e9OfTheSize) {
  const TempFolder folder;
  for (const SampleCurve& sample : SampleCurves()) {
    for (const bool step : {true, false}) {
      const auto path = folder / (step ? "curve.step" : "curve.igs");
      const CurveDocument document{sample.curve, "m"};
      step ? WriteStep(path, document) : WriteIges(path, document);
      const CurveDocument read = step ? ReadStepCurve(path) : ReadIgesCurve(path);
      EXPECT_EQ(read.unit, "m");
      const BSplineBasis &a = sample.curve.basis(), &b = read.curve.basis();
      ASSERT_NEAR(a.begin(), b.begin(), 1e-12) << sample.name;
      ASSERT_NEAR(a.end(), b.end(), 1e-12) << sample.name;
      EXPECT_EQ(a.degree(), b.degree());
      Random random(5);
      double worst = 0;
      for (int k = 0; k < 1000; ++k) {
        const double t = random.Uniform(a.begin(), a.end());
        worst = std::max(worst, (sample.curve.Evaluate(t) - read.curve.Evaluate(t)).norm());
      }
      EXPECT_LT(worst, 1e-9 * 40) << sample.name << path;
    }
  }
}

TEST(CurveCad, Iges_HoldsEntity126) {
  const TempFolder folder;
  WriteIges(folder / "curve.igs", CurveDocument{Closed(3, 11, false), "mm"});
  EXPECT_NE(FileText(folder / "curve.igs").find("     126 "), std::string::npos);
}

TEST(CurveCad, CurveThatIsAPoint_IsRefused) {
  const TempFolder folder;
  const NurbsCurve point(BSplineBasis(1, {0, 0, 1, 1}), {{1, 2, 3}, {1, 2, 3}});
  MessageOf<FitError>([&] { WriteStep(folder / "a.step", CurveDocument{point, "mm"}); });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.step"));
}

}  // namespace
}  // namespace frond
