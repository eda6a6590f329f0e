// SPDX-License-Identifier: BSD-3-Clause
// What rational curves of degree 2 hold exactly is found exactly, from points alone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/curve_spans.h"
#include "tests/problems/curve/curve_cases.h"

namespace frond {
namespace {

struct Conic {
  const char* name;
  double a, b, turn;  // half axes; angle covered
  int points, control_points;
};
void PrintTo(const Conic& conic, std::ostream* out) { *out << conic.name; }

class ConicCurve : public ::testing::TestWithParam<Conic> {};

TEST_P(ConicCurve, OfDegreeTwoWithFreeWeights_IsExact) {
  const Conic& conic = GetParam();
  CurveFitOptions options;
  options.degree = 2;
  options.control_points = conic.control_points;
  options.closed = std::nullopt;
  options.unknowns = CurveUnknowns::kBoth;
  const CurveFit fit = Fitted(
      EllipsePoints(conic.points, conic.a, conic.b, 0.3, conic.turn * std::numbers::pi / 180), options);
  EXPECT_EQ(fit.closed(), conic.turn == 360);
  EXPECT_LT(Largest(fit.distances), 1e-9 * 2 * conic.a)
      << fit.report.message << ", " << fit.report.iterations << " iterations";
  // Between the points too: (x/a)² + (y/b)² = 1.
  const CurveSpans spans(fit.curve);
  for (const Eigen::Vector3d& point : CurvePolyline(spans, 50)) {
    EXPECT_NEAR(std::hypot((point.x() - 3) / conic.a, (point.y() + 2) / conic.b), 1, 1e-8);
    EXPECT_EQ(point.z(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ConicCurve,
    ::testing::Values(Conic{"circle", 10, 10, 360, 60, 6}, Conic{"circle_many", 10, 10, 360, 400, 20},
                      Conic{"ellipse", 12, 4, 360, 100, 8}, Conic{"ellipse_six", 12, 7, 360, 100, 6},
                      Conic{"arc", 10, 10, 90, 30, 3}, Conic{"arc_five", 10, 10, 120, 30, 5},
                      Conic{"wide_arc", 10, 10, 270, 60, 5}, Conic{"widest_arc", 10, 10, 330, 60, 7},
                      Conic{"arc_of_ellipse", 12, 5, 160, 50, 4}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace frond
