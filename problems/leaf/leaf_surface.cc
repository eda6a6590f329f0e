// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_surface.h"

#include <Eigen/QR>
#include <array>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

using Row = std::vector<Eigen::Vector3d>;
using Grid = std::vector<Row>;

bool HasLength(const Row& row) {
  for (const Eigen::Vector3d& p : row) {
    if (p != row.front()) return true;
  }
  return false;
}

Grid Transposed(const Grid& grid) {
  Grid result(grid.front().size(), Row(grid.size()));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (std::size_t j = 0; j < grid[i].size(); ++j) result[j][i] = grid[i][j];
  }
  return result;
}

void AddTo(std::vector<double>* sum, const std::vector<double>& values) {
  if (sum->empty()) sum->assign(values.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) (*sum)[i] += values[i];
}

void Divide(std::vector<double>* sum, double count) {
  for (double& value : *sum) value /= count;
}

// A7 where the curve passes through all points, A8 otherwise.
BSplineBasis RowBasis(int degree, int count, std::span<const double> parameters) {
  return static_cast<std::size_t>(count) == parameters.size() ? InterpolationBasis(degree, parameters)
                                                              : ApproximationBasis(degree, count, parameters);
}

// One direction of a surface fit: control points of each row's curve, and the basis that they share.
struct Direction {
  Grid control;
  BSplineBasis basis;
};

// Algorithm 1, steps (1) and (2): each row with its own parameters and knots; then the mean of the knots.
Direction FitRowsApart(const Grid& rows, int degree, int count, Parametrisation method) {
  Grid control;
  std::vector<double> knots;
  double counted = 0;
  for (const Row& row : rows) {
    if (!HasLength(row)) {
      control.emplace_back(static_cast<std::size_t>(count), row.front());
      continue;
    }
    const std::vector<double> parameters = Parametrise(row, method);
    const BSplineBasis basis = RowBasis(degree, count, parameters);
    control.push_back(FitRow(row, parameters, basis));
    AddTo(&knots, basis.knots());
    ++counted;
  }
  Divide(&knots, counted);
  return {std::move(control), BSplineBasis(degree, std::move(knots))};
}

// Algorithm A1, step (1) and (2) or (3): mean parameters first, one basis and one fit for all rows.
Direction FitRowsTogether(const Grid& rows, const Grid& parameter_rows, int degree, int count,
                          Parametrisation method) {
  std::vector<double> parameters;
  double counted = 0;
  for (const Row& row : parameter_rows) {
    if (!HasLength(row)) continue;
    AddTo(&parameters, Parametrise(row, method));
    ++counted;
  }
  Divide(&parameters, counted);
  Direction result{{}, RowBasis(degree, count, parameters)};
  for (const Row& row : rows) result.control.push_back(FitRow(row, parameters, result.basis));
  return result;
}

void CheckOptions(const PointSet& set, const LeafSurfaceOptions& o) {
  if (o.degree_u < 1 || o.degree_v < 1 || o.count_u <= o.degree_u || o.count_v <= o.degree_v) {
    throw ConfigError("surface.control_points must exceed surface.degree in each direction");
  }
  const bool interpolation = o.algorithm == LeafSurfaceAlgorithm::kInterpolation;
  if (o.algorithm != LeafSurfaceAlgorithm::kAlgorithm1 && set.kind != PointSetKind::kOrdered) {
    throw ConfigError(
        std::string("paper.algorithm ") + (interpolation ? "interpolation" : "approximation") +
        " needs an ordered point set (point_set.kind: ordered, on a leaf whose midrib stands out); "
        "algorithm_1 takes any");
  }
  if (interpolation) return;
  if (static_cast<std::size_t>(o.count_v) > set.rows.size()) {
    throw ConfigError("surface.control_points asks for " + std::to_string(o.count_v) +
                      " along the leaf, more than " + std::to_string(set.rows.size()) +
                      " selected slices (point_set.selected)");
  }
  for (const Row& row : set.rows) {
    if (static_cast<std::size_t>(o.count_u) > row.size()) {
      throw ConfigError("surface.control_points asks for " + std::to_string(o.count_u) +
                        " across the leaf, more than " + std::to_string(row.size()) +
                        " points of a slice (point_set.left + point_set.right + 3)");
    }
  }
}

}  // namespace

Row FitRow(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
           const BSplineBasis& basis) {
  const int count = basis.num_control_points(), degree = basis.degree();
  const auto rows = static_cast<Eigen::Index>(points.size());
  if (rows < count) {
    throw InputError("a row of " + std::to_string(rows) + " points does not determine " +
                     std::to_string(count) + " control points");
  }
  Row control(static_cast<std::size_t>(count));
  control.front() = points.front();
  control.back() = points.back();
  if (count == 2) return control;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows - 2, count);
  Eigen::MatrixXd right(rows - 2, 3);
  std::array<double, kMaxDegree + 1> values;
  for (Eigen::Index k = 0; k < rows - 2; ++k) {
    const std::size_t point = static_cast<std::size_t>(k) + 1;
    const double t = parameters[point];
    const int span = basis.FindSpan(t);
    basis.Evaluate(span, t, 0, values.data());
    for (int a = 0; a <= degree; ++a) matrix(k, span - degree + a) = values[static_cast<std::size_t>(a)];
    right.row(k) =
        (points[point] - matrix(k, 0) * points.front() - matrix(k, count - 1) * points.back()).transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix.middleCols(1, count - 2));
  if (qr.rank() < count - 2) throw InputError("a row's points leave a control point undetermined");
  const Eigen::MatrixXd inner = qr.solve(right);
  for (int i = 1; i + 1 < count; ++i) control[static_cast<std::size_t>(i)] = inner.row(i - 1).transpose();
  return control;
}

NurbsSurface FitLeafSurface(const PointSet& set, const LeafSurfaceOptions& options) {
  CheckOptions(set, options);
  LeafSurfaceOptions o = options;
  if (o.algorithm == LeafSurfaceAlgorithm::kInterpolation) {
    o.count_u = static_cast<int>(set.rows.front().size());
    o.count_v = static_cast<int>(set.rows.size());
    if (o.count_u <= o.degree_u || o.count_v <= o.degree_v) {
      throw ConfigError("paper.algorithm interpolation: surface.degree must be below the point set's counts");
    }
  }
  const bool apart = o.algorithm == LeafSurfaceAlgorithm::kAlgorithm1;
  const Direction across =
      apart ? FitRowsApart(set.rows, o.degree_u, o.count_u, o.parametrisation)
            : FitRowsTogether(set.rows, set.rows, o.degree_u, o.count_u, o.parametrisation);
  const Grid strips = Transposed(across.control);  // [i][j], i across, j the slices
  // A1 takes the parameters along from the points, Algorithm 1 from the curves' control points.
  const Direction along =
      apart ? FitRowsApart(strips, o.degree_v, o.count_v, o.parametrisation)
            : FitRowsTogether(strips, Transposed(set.rows), o.degree_v, o.count_v, o.parametrisation);
  Row control;
  for (const Row& row : along.control) control.insert(control.end(), row.begin(), row.end());
  return NurbsSurface(across.basis, along.basis, std::move(control));
}

}  // namespace frond
