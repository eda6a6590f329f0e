// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_parameters.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/errors.h"
#include "models/curve_foot_point.h"
#include "models/knot_vector.h"
#include "problems/curve/curve_order.h"
#include "problems/curve/parametric_start.h"
#include "problems/surface/principal_axes.h"

namespace frond {
namespace {

constexpr int kCoarsest = 8, kFinest = 24;  // control points of base curves
constexpr double kBaseFairness = 1e-7;

using Points = std::vector<Eigen::Vector3d>;

// Sorts by parameter and brings the parameters to [0, 1], or to a turn from the first.
LocatedPoints Sorted(const std::vector<double>& parameters, bool closed) {
  LocatedPoints located;
  located.closed = closed;
  located.order.resize(parameters.size());
  std::iota(located.order.begin(), located.order.end(), 0);
  std::stable_sort(located.order.begin(), located.order.end(),
                   [&](std::size_t a, std::size_t b) { return parameters[a] < parameters[b]; });
  const double first = parameters[located.order.front()], last = parameters[located.order.back()];
  if (!closed && !(last > first)) {
    throw InputError("all points project on one point of the base curve; take another ('curve.base')");
  }
  for (const std::size_t i : located.order) {
    located.parameters.push_back((parameters[i] - first) / (closed ? 1 : last - first));
  }
  return located;
}

Points InOrder(std::span<const Eigen::Vector3d> points, const std::vector<std::size_t>& order) {
  Points sorted;
  for (const std::size_t i : order) sorted.push_back(points[i]);
  return sorted;
}

LocatedPoints OnLine(std::span<const Eigen::Vector3d> points) {
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  Eigen::Vector3d direction = axes.axes.col(0);
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0) direction = -direction;
  std::vector<double> parameters;
  for (const Eigen::Vector3d& point : points) parameters.push_back(direction.dot(point - axes.origin));
  return Sorted(parameters, false);
}

// Kåsa's circle: least squares of |q|² − 2 c·q − k in the principal plane.
LocatedPoints OnCircle(std::span<const Eigen::Vector3d> points, std::optional<bool> closed) {
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd squares(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Vector2d q =
        axes.axes.leftCols<2>().transpose() * (points[static_cast<std::size_t>(i)] - axes.origin);
    rows.row(i) << 2 * q.x(), 2 * q.y(), 1;
    squares[i] = q.squaredNorm();
  }
  const Eigen::Vector3d circle = rows.colPivHouseholderQr().solve(squares);
  std::vector<double> turns;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double turn =
        std::atan2(rows(i, 1) / 2 - circle[1], rows(i, 0) / 2 - circle[0]) / (2 * std::numbers::pi);
    turns.push_back(turn < 0 ? turn + 1 : turn);
  }
  LocatedPoints around = Sorted(turns, true);
  around.closed = closed.value_or(LooksClosed(InOrder(points, around.order)));
  if (around.closed) return around;
  // Open: from behind the largest gap.
  std::size_t start = 0;
  double largest = around.parameters.front() + 1 - around.parameters.back();
  for (std::size_t i = 1; i < around.parameters.size(); ++i) {
    const double gap = around.parameters[i] - around.parameters[i - 1];
    if (gap > largest) {
      largest = gap;
      start = i;
    }
  }
  for (std::size_t i = 0; i < start; ++i) turns[around.order[i]] += 1;
  return Sorted(turns, false);
}

LocatedPoints AlongChain(std::span<const Eigen::Vector3d> points, std::optional<bool> closed) {
  const PointChain chain = FindChain(points, closed);
  return Sorted(ProjectOnChain(points, chain), chain.closed);
}

LocatedPoints AsGiven(std::span<const Eigen::Vector3d> points, const std::vector<std::size_t>& order,
                      bool closed, Parametrisation method) {
  const Points sorted = InOrder(points, order);
  return {order, closed ? ParametriseClosed(sorted, method) : Parametrise(sorted, method), closed};
}

// On a coarse curve through the points with their present parameters.
LocatedPoints OnFittedCurve(std::span<const Eigen::Vector3d> points, const LocatedPoints& located,
                            const CurveFitOptions& options, int repeat) {
  const int degree = std::min(3, static_cast<int>(points.size()) / 2 - 1);
  if (degree < 1) return located;
  const int wanted = std::min(kCoarsest << repeat, kFinest);
  const int most = std::max(degree + 1, static_cast<int>(points.size()) / 3);
  const int count = std::clamp(wanted, degree + 1, most);
  const BSplineBasis basis =
      located.closed ? PeriodicUniformBasis(degree, count) : UniformBasis(degree, count);
  const NurbsCurve base = FitCurveAtParameters(InOrder(points, located.order), located.parameters, basis,
                                               std::max(options.fairness.value_or(0), kBaseFairness));
  const CurveSpans spans(base);
  const CurveFootSearch search(spans);
  std::vector<double> feet;
  for (const Eigen::Vector3d& point : points) feet.push_back(search.Find(point).t);
  return Sorted(feet, located.closed);
}

}  // namespace

LocatedPoints LocatePoints(std::span<const Eigen::Vector3d> points, const CurveFitOptions& options) {
  CurveParametrisation method = options.parametrisation;
  const bool find = options.order == CurveOrder::kFind;
  if (method == CurveParametrisation::kAuto) {
    method = find ? CurveParametrisation::kBaseCurve : CurveParametrisation::kChord;
  }
  LocatedPoints located;
  const bool on_primitive = method == CurveParametrisation::kBaseCurve && options.base != BaseCurve::kFitted;
  if (on_primitive && options.base == BaseCurve::kLine) {
    if (options.closed.value_or(false)) {
      throw ConfigError("'curve.base: line' is no base of a closed curve; take circle or fitted");
    }
    located = OnLine(points);
  } else if (on_primitive) {
    located = OnCircle(points, options.closed);
  } else if (find) {
    located = AlongChain(points, options.closed);
  } else {
    located.order.resize(points.size());
    std::iota(located.order.begin(), located.order.end(), 0);
    located.closed = options.closed.value_or(LooksClosed(points));
  }
  switch (method) {
    case CurveParametrisation::kUniform:
      return AsGiven(points, located.order, located.closed, Parametrisation::kUniform);
    case CurveParametrisation::kCentripetal:
      return AsGiven(points, located.order, located.closed, Parametrisation::kCentripetal);
    case CurveParametrisation::kBaseCurve:
      break;
    default:
      return AsGiven(points, located.order, located.closed, Parametrisation::kChord);
  }
  if (located.parameters.empty()) {
    located = AsGiven(points, located.order, located.closed, Parametrisation::kChord);
  }
  for (int repeat = 0; repeat < options.base_repeats; ++repeat) {
    located = OnFittedCurve(points, located, options, repeat);
  }
  return located;
}

}  // namespace frond
