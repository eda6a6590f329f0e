// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/ma_fit.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/errors.h"
#include "models/surface_cells.h"
#include "problems/surface/cell_moments.h"
#include "problems/surface/rational_sums.h"
#include "problems/surface/thin_plate.h"

namespace frond {
namespace {

// Control points that repeat in a periodic direction are one unknown.
std::vector<Eigen::Index> UnknownsOf(const BSplineBasis& u, const BSplineBasis& v) {
  const int du = u.num_distinct_control_points(), dv = v.num_distinct_control_points();
  std::vector<Eigen::Index> unknown;
  for (int i = 0; i < u.num_control_points(); ++i) {
    for (int j = 0; j < v.num_control_points(); ++j) unknown.push_back((i % du) * dv + j % dv);
  }
  return unknown;
}

// A cell's entry (a, b) of 4 × 4: [I, −Q; −Qᵀ, |Q|²] times b_a b_b.
void AddEntry(const Eigen::Matrix4d& entry, Eigen::Index a, Eigen::Index b, RationalSums* sums) {
  sums->gram(a, b) += entry(0, 0);
  for (Eigen::Index c = 0; c < 3; ++c) sums->moment[static_cast<std::size_t>(c)](a, b) -= entry(c, 3);
  sums->square(a, b) += entry(3, 3);
}

}  // namespace

NurbsSurface FitRationalAtParameters(std::span<const Eigen::Vector3d> points,
                                     std::span<const Eigen::Vector2d> parameters, const BSplineBasis& u,
                                     const BSplineBasis& v, double fairness) {
  const std::vector<Eigen::Index> unknown = UnknownsOf(u, v);
  const Eigen::Index unknowns = u.num_distinct_control_points() * v.num_distinct_control_points();
  if (unknowns > kMaxMaWeights) {
    throw ConfigError("the weights of " + std::to_string(unknowns) +
                      " control points are too many for Ma's two steps (at most " +
                      std::to_string(kMaxMaWeights) + "); set surface.control_points lower");
  }
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& point : points) centre += point / static_cast<double>(points.size());
  double squared = 0;
  for (const auto& point : points) squared += (point - centre).squaredNorm();
  const double scale = std::sqrt(squared / static_cast<double>(points.size()));
  if (!(scale > 0)) throw FitError("the fit at fixed parameters is singular: all points are equal");

  const NurbsSurface blank(u, v, std::vector<Eigen::Vector3d>(unknown.size(), Eigen::Vector3d::Zero()));
  const SurfaceCells cells(blank);
  std::vector<CellMoments> moments(static_cast<std::size_t>(cells.count()),
                                   CellMoments(u.degree(), v.degree(), 4, 4));
  const double no_vector[4] = {};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double pu = u.begin() + parameters[i][0] * (u.end() - u.begin());
    const double pv = v.begin() + parameters[i][1] * (v.end() - v.begin());
    const int ku = cells.u().SpanOf(pu), kv = cells.v().SpanOf(pv);
    const Eigen::Vector3d q = (points[i] - centre) / scale;
    const double matrix[10] = {1, 0, 1, 0, 0, 1, -q.x(), -q.y(), -q.z(), q.squaredNorm()};
    moments[static_cast<std::size_t>(ku * cells.v().count() + kv)].Add(
        (pu - cells.u().begin(ku)) / cells.u().length(ku), (pv - cells.v().begin(kv)) / cells.v().length(kv),
        matrix, no_vector);
  }
  RationalSums sums(unknowns);
  const std::vector<Eigen::MatrixXd> gram = ThinPlateGram(cells);
  const double plate = fairness * static_cast<double>(points.size());
  const Eigen::Index nu = u.degree() + 1, nv = v.degree() + 1, local = nu * nv;
  for (std::size_t c = 0; c < moments.size(); ++c) {
    const int ku = static_cast<int>(c) / cells.v().count(), kv = static_cast<int>(c) % cells.v().count();
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(4 * local, 4 * local);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(4 * local);
    moments[c].AddTo(cells.u().coefficients(ku), cells.v().coefficients(kv), &h, &g);
    const auto unknown_of = [&](Eigen::Index a) {
      const auto i = static_cast<std::size_t>(cells.u().first(ku) + a / nv);
      return unknown[i * static_cast<std::size_t>(v.num_control_points()) +
                     static_cast<std::size_t>(cells.v().first(kv) + a % nv)];
    };
    for (Eigen::Index a = 0; a < local; ++a) {
      for (Eigen::Index b = 0; b < local; ++b) {
        Eigen::Matrix4d entry = h.block<4, 4>(4 * a, 4 * b);
        entry.diagonal().array() += plate * gram[c](a, b);
        AddEntry(entry, unknown_of(a), unknown_of(b), &sums);
      }
    }
  }
  const RationalSolution solution = SolveRationalSums(sums);
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> weights;
  for (const Eigen::Index k : unknown) {
    control_points.emplace_back(centre + scale * solution.points.row(k).transpose());
    weights.push_back(solution.weights[k]);
  }
  return NurbsSurface(u, v, std::move(control_points), std::move(weights));
}

}  // namespace frond
