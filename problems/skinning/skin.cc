// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/errors.h"
#include "problems/skinning/basis_matrix.h"
#include "problems/skinning/compatible_curves.h"

namespace frond {
namespace {

using Eigen::Index;

// The distinct control points of compatible sections: row l of `weight` and `weighted[axis]` is section l.
struct SectionRows {
  Eigen::MatrixXd weight;
  std::array<Eigen::MatrixXd, 3> weighted;  // w P
  std::vector<double> angle;                // φ_i of a column, for poles

  explicit SectionRows(const std::vector<NurbsCurve>& curves) {
    const BSplineBasis& basis = curves.front().basis();
    const auto rows = static_cast<Index>(curves.size()), columns = Index{basis.num_distinct_control_points()};
    weight.resize(rows, columns);
    for (auto& axis : weighted) axis.resize(rows, columns);
    for (Index l = 0; l < rows; ++l) {
      const NurbsCurve& curve = curves[static_cast<std::size_t>(l)];
      for (Index i = 0; i < columns; ++i) {
        const auto at = static_cast<std::size_t>(i);
        weight(l, i) = curve.weights()[at];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          weighted[axis](l, i) = curve.weights()[at] * curve.control_points()[at][static_cast<Index>(axis)];
        }
      }
    }
    for (int i = 0; i < basis.num_distinct_control_points(); ++i) angle.push_back(GrevilleAngle(basis, i));
  }

  Index rows() const { return weight.rows(); }
  Index columns() const { return weight.cols(); }
  Eigen::Vector3d Point(Index l, Index i) const {
    return Eigen::Vector3d(weighted[0](l, i), weighted[1](l, i), weighted[2](l, i)) / weight(l, i);
  }
};

// v of the sections, with those of the poles at the ends: the mean over the columns.
std::vector<double> Stations(const SectionRows& rows, const SkinOptions& options) {
  std::vector<double> mean;
  int used = 0;
  for (Index i = 0; i < rows.columns(); ++i) {
    std::vector<Eigen::Vector3d> column;
    if (options.first_pole) column.push_back(*options.first_pole);
    for (Index l = 0; l < rows.rows(); ++l) column.push_back(rows.Point(l, i));
    if (options.last_pole) column.push_back(*options.last_pole);
    mean.resize(column.size(), 0.0);
    double length = 0;
    for (std::size_t k = 1; k < column.size(); ++k) length += (column[k] - column[k - 1]).norm();
    if (!(length > 0)) continue;
    const std::vector<double> v = Parametrise(column, options.parametrisation);
    for (std::size_t k = 0; k < v.size(); ++k) mean[k] += v[k];
    ++used;
  }
  for (double& v : mean) v /= std::max(used, 1);
  for (std::size_t k = 1; k < mean.size(); ++k) {
    if (!(mean[k] > mean[k - 1])) {
      const std::size_t section = k + (options.first_pole ? 0 : 1);
      throw InputError("sections " + std::to_string(section - 1) + " and " + std::to_string(section) +
                       " coincide: leave one out");
    }
  }
  mean.back() = 1;
  return mean;
}

// The end control point's neighbour is the end plus this many times the derivative into the domain.
double EndStep(const BSplineBasis& basis, bool first) {
  const std::vector<double>& knots = basis.knots();
  const auto degree = static_cast<std::size_t>(basis.degree());
  const std::size_t k = first ? 1 : knots.size() - degree - 2;
  return (knots[k + degree] - knots[k]) / basis.degree();
}

// The net of an unfinished skin: `weight` and `weighted` as in SectionRows, a row for each control point in
// v.
struct Net {
  Eigen::MatrixXd weight;
  std::array<Eigen::MatrixXd, 3> weighted;

  Net(Index rows, Index columns) : weight(rows, columns) {
    for (auto& axis : weighted) axis = Eigen::MatrixXd::Zero(rows, columns);
  }
};

// Solves eqs (32) and (33) for the rows between the fixed ends.
class SkinSystem {
 public:
  // `tied`: rows beside poles follow P₀ + cos φ A + sin φ B, else they are free as any other.
  SkinSystem(const SectionRows& sections, const SkinOptions& options, const BSplineBasis& basis,
             std::span<const double> v, bool tied)
      : sections_(sections), net_(basis.num_control_points(), sections.columns()) {
    const Index last = basis.num_control_points() - 1;
    const Eigen::MatrixXd matrix = BasisMatrix(basis, v);
    matrix_ = matrix;
    if (options.first_pole) poles_.push_back({*options.first_pole, 0, tied ? 1 : -1});
    if (options.last_pole) poles_.push_back({*options.last_pole, last, tied ? last - 1 : -1});
    const Index begin = options.first_pole && tied ? 2 : 1;
    const Index end = options.last_pole && tied ? last - 1 : last;  // free rows [begin, end)
    free_begin_ = begin;
    free_ = matrix.middleCols(begin, end - begin);
    if (free_.cols() > 0) solver_.compute(free_);
    FixEnds(options, last);
    SolveWeights();
  }

  // A and B of every pole that meet eq. (33) best, the free rows eliminated.
  void TieByLeastSquares() {
    if (poles_.empty()) return;
    for (std::size_t p = 0; p < poles_.size(); ++p) Tie(p, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    const Index columns = sections_.columns(), unknowns = 2 * static_cast<Index>(poles_.size());
    Eigen::MatrixXd left(free_.rows() * columns, unknowns), right(free_.rows() * columns, 3);
    for (Index i = 0; i < columns; ++i) {
      const Index at = i * free_.rows();
      for (std::size_t p = 0; p < poles_.size(); ++p) {
        const Eigen::VectorXd weighted = matrix_.col(poles_[p].tied) * net_.weight(poles_[p].tied, i);
        const Eigen::VectorXd column = Unmet(weighted);
        left.col(2 * static_cast<Index>(p)).segment(at, free_.rows()) = std::cos(Angle(i)) * column;
        left.col(2 * static_cast<Index>(p) + 1).segment(at, free_.rows()) = std::sin(Angle(i)) * column;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        right.col(static_cast<Index>(axis)).segment(at, free_.rows()) = Unmet(Rest(axis, i));
      }
    }
    const Eigen::MatrixXd solution = left.colPivHouseholderQr().solve(right);
    for (std::size_t p = 0; p < poles_.size(); ++p) {
      Tie(p, solution.row(2 * static_cast<Index>(p)), solution.row(2 * static_cast<Index>(p) + 1));
    }
  }

  // Pole p's row beside it becomes P₀ + cos φ_i A + sin φ_i B.
  void Tie(std::size_t p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    for (Index i = 0; i < sections_.columns(); ++i) {
      const Eigen::Vector3d point = poles_[p].point + std::cos(Angle(i)) * a + std::sin(Angle(i)) * b;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        net_.weighted[axis](poles_[p].tied, i) =
            net_.weight(poles_[p].tied, i) * point[static_cast<Index>(axis)];
      }
    }
  }

  // The same from dP/dv = A cos φ_i + B sin φ_i at the pole.
  void TieToTangents(std::size_t p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     const BSplineBasis& basis) {
    const double step = EndStep(basis, poles_[p].row == 0);
    Tie(p, step * a, step * b);
  }

  Net Solve() {
    if (free_.cols() == 0) return net_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (Index i = 0; i < sections_.columns(); ++i) {
        net_.weighted[axis].col(i).segment(free_begin_, free_.cols()) = solver_.solve(Rest(axis, i));
      }
    }
    return net_;
  }

 private:
  struct Pole {
    Eigen::Vector3d point;
    Index row, tied;
  };

  double Angle(Index i) const { return sections_.angle[static_cast<std::size_t>(i)]; }

  // Clamped ends: the first and last row are the first and last section or the pole, whose weights are even.
  void FixEnds(const SkinOptions& options, Index last) {
    net_.weight.setZero();
    for (const bool first : {true, false}) {
      const Index row = first ? 0 : last, section = first ? 0 : sections_.rows() - 1;
      const auto& point = first ? options.first_pole : options.last_pole;
      if (!point) {
        net_.weight.row(row) = sections_.weight.row(section);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          net_.weighted[axis].row(row) = sections_.weighted[axis].row(section);
        }
        continue;
      }
      const double even = sections_.weight.row(section).mean();
      net_.weight.row(row).setConstant(even);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        net_.weighted[axis].row(row).setConstant(even * (*point)[static_cast<Index>(axis)]);
      }
    }
    for (const Pole& pole : poles_) {
      if (pole.tied >= 0) net_.weight.row(pole.tied) = net_.weight.row(pole.row);
    }
  }

  void SolveWeights() {
    if ((sections_.weight.array() == 1).all()) {
      net_.weight.setOnes();
      return;
    }
    if (free_.cols() > 0) {
      const Eigen::MatrixXd rest = sections_.weight - matrix_ * net_.weight;
      net_.weight.middleRows(free_begin_, free_.cols()) = solver_.solve(rest);
    }
    if (!(net_.weight.minCoeff() > 0)) {
      throw FitError(
          "the skin's weights by eq. (32) are not all positive: fit sections without weights or take "
          "fewer control points along v");
    }
  }

  // What the free rows leave of a right-hand side.
  Eigen::VectorXd Unmet(const Eigen::VectorXd& right) const {
    return free_.cols() == 0 ? right : right - free_ * solver_.solve(right);
  }

  // The right-hand side of eq. (33) for column i less what the fixed rows give.
  Eigen::VectorXd Rest(std::size_t axis, Index i) const {
    Eigen::VectorXd rest = sections_.weighted[axis].col(i);
    for (Index j = 0; j < matrix_.cols(); ++j) {
      if (j >= free_begin_ && j < free_begin_ + free_.cols()) continue;
      rest -= matrix_.col(j) * net_.weighted[axis](j, i);
    }
    return rest;
  }

  const SectionRows& sections_;
  Net net_;
  std::vector<Pole> poles_;
  Eigen::MatrixXd matrix_, free_;
  Index free_begin_ = 1;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

// dP/dv at a pole for each column of a skin that meets it without a condition, as A cos φ_i + B sin φ_i.
std::pair<Eigen::Vector3d, Eigen::Vector3d> TangentsAtPole(const Net& net, const BSplineBasis& basis,
                                                           std::span<const double> angle, bool first) {
  const Index row = first ? 0 : net.weight.rows() - 1, beside = first ? 1 : row - 1;
  const double step = EndStep(basis, first);
  Eigen::MatrixXd left(net.weight.cols(), 2), right(net.weight.cols(), 3);
  for (Index i = 0; i < net.weight.cols(); ++i) {
    left(i, 0) = std::cos(angle[static_cast<std::size_t>(i)]);
    left(i, 1) = std::sin(angle[static_cast<std::size_t>(i)]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double difference = net.weighted[axis](beside, i) / net.weight(beside, i) -
                                net.weighted[axis](row, i) / net.weight(row, i);
      right(i, static_cast<Index>(axis)) = difference / step;
    }
  }
  const Eigen::MatrixXd solution = left.colPivHouseholderQr().solve(right);
  return {solution.row(0), solution.row(1)};
}

NurbsSurface MakeSurface(const Net& net, const BSplineBasis& u, const BSplineBasis& v) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (Index i = 0; i < u.num_control_points(); ++i) {
    const Index column = i % net.weight.cols();
    for (Index j = 0; j < net.weight.rows(); ++j) {
      const double w = net.weight(j, column);
      weights.push_back(w);
      points.emplace_back(net.weighted[0](j, column) / w, net.weighted[1](j, column) / w,
                          net.weighted[2](j, column) / w);
    }
  }
  return NurbsSurface(u, v, std::move(points), std::move(weights));
}

}  // namespace

double GrevilleAngle(const BSplineBasis& basis, int i) {
  double sum = 0;
  for (int k = 1; k <= basis.degree(); ++k) sum += basis.knots()[static_cast<std::size_t>(i + k)];
  return 2 * std::numbers::pi * (sum / basis.degree() - basis.begin()) / (basis.end() - basis.begin());
}

Skin SkinCurves(std::span<const NurbsCurve> sections, const SkinOptions& options) {
  const std::vector<NurbsCurve> curves = MakeCompatible({sections.begin(), sections.end()});
  const BSplineBasis& u = curves.front().basis();
  const bool poles[] = {options.first_pole.has_value(), options.last_pole.has_value()};
  if ((poles[0] || poles[1]) && !u.periodic()) {
    throw InputError("a pole needs closed sections with a periodic basis");
  }
  if (options.degree < 2 && (poles[0] || poles[1])) {
    throw InputError(
        "a pole needs degree 2 or more along v ('surface.degree_v'), not 1; or end the surface in a plane or "
        "rim ('sections.first', 'sections.last')");
  }
  const int count = static_cast<int>(curves.size()), most = count + 2 * (poles[0] + poles[1]);
  if (most < options.degree + 1) {
    throw InputError("degree " + std::to_string(options.degree) + " along v needs at least " +
                     std::to_string(options.degree + 1 - 2 * (poles[0] + poles[1])) + " sections, not " +
                     std::to_string(count));
  }
  const int rows = options.control_points == 0 ? most : options.control_points;
  if (rows < options.degree + 1) {
    throw InputError("degree " + std::to_string(options.degree) + " along v needs at least " +
                     std::to_string(options.degree + 1) + " control points along v, not " +
                     std::to_string(rows));
  }
  const int fixed = 2 + poles[0] + poles[1];
  if (rows < fixed) {
    throw InputError("the ends take " + std::to_string(fixed) +
                     " control points along v, two for a pole and " +
                     "one for another end; 'surface.control_points_v' is " + std::to_string(rows) +
                     ": raise it, or set 'sections.first' or 'sections.last' to plane");
  }
  if (rows > most) {
    throw InputError(std::to_string(rows) + " control points along v are more than " + std::to_string(count) +
                     " sections determine (" + std::to_string(most) + ")");
  }
  const SectionRows section_rows(curves);
  const std::vector<double> stations = Stations(section_rows, options);
  std::vector<double> v(stations.begin() + poles[0], stations.end() - poles[1]);
  std::vector<double> knot_stations = stations;  // a pole stands for its tangent as well
  if (poles[0]) knot_stations.insert(knot_stations.begin(), 0.0);
  if (poles[1]) knot_stations.push_back(1.0);
  const BSplineBasis basis = rows == most ? InterpolationBasis(options.degree, knot_stations)
                                          : ApproximationBasis(options.degree, rows, knot_stations);
  SkinSystem system(section_rows, options, basis, v, /*tied=*/true);
  if (rows < most) {
    system.TieByLeastSquares();
  } else if (poles[0] || poles[1]) {
    const int degree = std::min(options.degree, static_cast<int>(stations.size()) - 1);
    const BSplineBasis free_basis = InterpolationBasis(degree, stations);
    const Net net = SkinSystem(section_rows, options, free_basis, v, /*tied=*/false).Solve();
    std::size_t pole = 0;
    for (const bool first : {true, false}) {
      if (!poles[first ? 0 : 1]) continue;
      const auto [a, b] = TangentsAtPole(net, free_basis, section_rows.angle, first);
      system.TieToTangents(pole++, a, b, basis);
    }
  }
  return {MakeSurface(system.Solve(), u, basis), std::move(v)};
}

}  // namespace frond
