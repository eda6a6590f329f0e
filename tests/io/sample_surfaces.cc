// SPDX-License-Identifier: BSD-3-Clause
#include "tests/io/sample_surfaces.h"

#include <cmath>
#include <numbers>

#include "models/knot_vector.h"

namespace frond {
namespace {

BSplineBasis ClampedBasis(int degree, int count) {
  std::vector<double> knots(static_cast<std::size_t>(degree + 1), 0.0);
  const int spans = count - degree;
  for (int k = 1; k < spans; ++k) knots.push_back((k + 0.1 * std::sin(3.0 * k)) / spans);
  knots.insert(knots.end(), static_cast<std::size_t>(degree + 1), 1.0);
  return {degree, knots};
}

BSplineBasis PeriodicBasis(int degree, int distinct) {
  std::vector<double> knots;
  for (int k = -degree; k <= distinct + degree; ++k) knots.push_back(static_cast<double>(k) / distinct);
  return {degree, knots, true};
}

double WeightAt(int i, int j, bool rational) {
  return rational ? 1 + 0.3 * std::sin(2.0 * i + 1.3 * j) : 1.0;
}

// A tube along z that closes in u.
NurbsSurface Tube(bool rational) {
  const int distinct = 9, degree = 3, count_v = 5;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < distinct + degree; ++i) {
    const int k = i % distinct;
    const double angle = 2 * std::numbers::pi * k / distinct;
    for (int j = 0; j < count_v; ++j) {
      const double radius = 10 + std::sin(1.7 * k) + j;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 8.0 * j);
      weights.push_back(WeightAt(k, j, rational));
    }
  }
  return {PeriodicBasis(degree, distinct), ClampedBasis(3, count_v), points, weights};
}

// A sheet whose row at u = 1 is one point.
NurbsSurface TippedSheet(bool rational) {
  const NurbsSurface sheet = WavySheet(3, 3, 8, 6, rational);
  std::vector<Eigen::Vector3d> points = sheet.control_points();
  for (std::size_t j = 0; j < 6; ++j) {
    points[7 * 6 + j] = Eigen::Vector3d(65, 20, 3);
    points[6 * 6 + j] = 0.5 * (points[6 * 6 + j] + points[7 * 6 + j]);
  }
  return {sheet.u(), sheet.v(), points, sheet.weights()};
}

NurbsSurface Moved(const NurbsSurface& surface, const Eigen::Vector3d& by) {
  std::vector<Eigen::Vector3d> points = surface.control_points();
  for (Eigen::Vector3d& point : points) point += by;
  return {surface.u(), surface.v(), points, surface.weights()};
}

std::vector<TrimLoop> WithHole(int vertices) {
  TrimLoop hole;
  for (int k = 0; k < 40; ++k) {
    const double angle = 2 * std::numbers::pi * k / 40;
    hole.emplace_back(0.5 + 0.08 * std::cos(angle), 0.45 + 0.1 * std::sin(angle));
  }
  return {LeafOutline(vertices), hole};
}

// All of the domain but a bite at the base: the loop runs along the collapsed edge u = 1.
std::vector<TrimLoop> AlongTheTip() {
  return {{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.3}, {1, 1}, {0, 1}, {0, 0.7}, {0.2, 0.5}, {0, 0.3}}};
}

}  // namespace

NurbsSurface WavySheet(int degree_u, int degree_v, int count_u, int count_v, bool rational) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < count_u; ++i) {
    for (int j = 0; j < count_v; ++j) {
      const double x = 60.0 * i / (count_u - 1), y = 40.0 * j / (count_v - 1);
      points.emplace_back(x + std::sin(y), y + std::cos(x), 3 * std::sin(0.15 * x) + 2 * std::cos(0.2 * y));
      weights.push_back(WeightAt(i, j, rational));
    }
  }
  return {ClampedBasis(degree_u, count_u), ClampedBasis(degree_v, count_v), points, weights};
}

namespace {

// Rows of control points from the pole up to `rows` of 12, the last of them a pole too where it is row 12.
NurbsSurface PearRows(double length, bool clockwise, int rows) {
  constexpr int kDistinct = 16, kDegree = 3, kLast = 11;
  const double radii[] = {0, 0.14, 0.28, 0.36, 0.38, 0.35, 0.29, 0.22, 0.17, 0.14, 0.08, 0};
  const double heights[] = {0, 0, 0.06, 0.16, 0.28, 0.4, 0.52, 0.64, 0.76, 0.88, 1, 1};
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kDistinct + kDegree; ++i) {
    const int k = i % kDistinct;
    const double angle = (clockwise ? -2 : 2) * std::numbers::pi * k / kDistinct;
    for (int j = 0; j < rows; ++j) {
      const bool polar = j <= 1 || j >= kLast - 1;  // the row next to a pole lies in a plane with it
      const double dent = polar ? 1 : 1 + 0.06 * std::sin(2 * angle + 0.5 * j);
      const double radius = radii[j] * dent;
      points.push_back(length * Eigen::Vector3d(radius * std::cos(angle), 0.9 * radius * std::sin(angle),
                                                heights[j] + (polar ? 0 : 0.02 * std::cos(3 * angle))));
    }
  }
  return {PeriodicUniformBasis(kDegree, kDistinct), UniformBasis(3, rows), points};
}

}  // namespace

NurbsSurface Pear(double length, bool clockwise) { return PearRows(length, clockwise, 12); }

NurbsSurface Cup() { return PearRows(80, false, 6); }

NurbsSurface Ring() {
  constexpr int kDistinctU = 14, kDistinctV = 9, kDegree = 3;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kDistinctU + kDegree; ++i) {
    const double a = 2 * std::numbers::pi * (i % kDistinctU) / kDistinctU;
    for (int j = 0; j < kDistinctV + kDegree; ++j) {
      const double b = 2 * std::numbers::pi * (j % kDistinctV) / kDistinctV;
      const double radius = 12 + 4 * std::cos(b);
      points.emplace_back(radius * std::cos(a), radius * std::sin(a), 4 * std::sin(b) + std::sin(2 * a));
    }
  }
  return {PeriodicUniformBasis(kDegree, kDistinctU), PeriodicUniformBasis(kDegree, kDistinctV), points};
}

NurbsSurface Sphere(double radius) {
  const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  const double r[] = {0, 1, 1, 1, 0}, z[] = {-1, -1, 0, 1, 1};
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 5; ++j) {
      points.push_back(radius * Eigen::Vector3d(r[j] * x[i], r[j] * y[i], z[j]));
      weights.push_back((i % 2 == 1 ? std::sqrt(0.5) : 1) * (j % 2 == 1 ? std::sqrt(0.5) : 1));
    }
  }
  return {BSplineBasis(2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}),
          BSplineBasis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), points, weights};
}

TrimLoop LeafOutline(int vertices) {
  TrimLoop loop;
  for (int k = 0; k < vertices; ++k) {
    const double angle = 2 * std::numbers::pi * k / vertices;
    const double radius = 0.42 + 0.015 * std::sin(23 * angle);  // with a toothed margin
    loop.emplace_back(0.5 + radius * std::cos(angle), 0.5 + 0.7 * radius * std::sin(angle));
  }
  return loop;
}

std::vector<SampleSurface> SampleSurfaces() {
  const Eigen::Vector3d survey(476773.25, 5429145.5, 263.125);
  return {{"Plain", {WavySheet(3, 3, 8, 6, false), {}}},
          {"Rational", {WavySheet(3, 3, 8, 6, true), {}}},
          {"Trimmed", {WavySheet(3, 3, 8, 6, false), WithHole(300)}},
          {"RationalTrimmed", {WavySheet(3, 2, 8, 6, true), WithHole(1000)}},
          {"Tip", {TippedSheet(false), {}}},
          {"RationalTip", {TippedSheet(true), {}}},
          {"TrimmedAlongTip", {TippedSheet(false), AlongTheTip()}},
          {"Periodic", {Tube(false), {}}},
          {"RationalPeriodic", {Tube(true), {}}},
          {"TrimmedPeriodic", {Tube(false), {LeafOutline(100)}}},
          {"Pear", {Pear(80), {}}},
          {"Cup", {Cup(), {}}},
          {"Ring", {Ring(), {}}},
          {"Sphere", {Sphere(10), {}}},
          {"SurveyCoordinates", {Moved(WavySheet(3, 3, 8, 6, false), survey), WithHole(200)}},
          {"Bilinear", {WavySheet(1, 1, 4, 3, false), {LeafOutline(60)}}},
          {"HighDegree", {WavySheet(5, 4, 9, 8, true), {LeafOutline(60)}}}};
}

}  // namespace frond
