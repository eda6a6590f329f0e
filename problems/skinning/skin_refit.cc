// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin_refit.h"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "models/foot_point_search.h"
#include "models/surface_cells.h"

namespace frond {
namespace {

constexpr int kIterations = 10;
constexpr int kSamplesPerControlPoint = 2;
constexpr double kTangential = 0.1;     // weight of moves along the surface
constexpr double kSmallestStep = 1e-7;  // of the surface's size

// Which unknown vectors a control point is made of, with what factors; none for fixed ones.
struct Term {
  int unknown;
  double factor;
};
using Terms = std::vector<Term>;

class RefitProblem {
 public:
  RefitProblem(const NurbsSurface& surface, const SkinOptions& options)
      : columns_(surface.u().num_distinct_control_points()), rows_(surface.count_v()) {
    const int begin = options.first_pole ? 2 : 1, end = rows_ - (options.last_pole ? 2 : 1);
    terms_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (int i = 0; i < columns_; ++i) {
      for (int j = begin; j < end; ++j) terms_[At(i, j)] = {{unknowns_++, 1.0}};
    }
    for (const bool first : {true, false}) {
      if (!(first ? options.first_pole : options.last_pole)) continue;
      for (int i = 0; i < columns_; ++i) {
        const double angle = GrevilleAngle(surface.u(), i);
        terms_[At(i, first ? 1 : rows_ - 2)] = {{unknowns_, std::cos(angle)},
                                                {unknowns_ + 1, std::sin(angle)}};
      }
      unknowns_ += 2;
    }
  }

  int unknowns() const { return unknowns_; }
  const Terms& terms(int i, int j) const { return terms_[At(i % columns_, j)]; }

  NurbsSurface Moved(const NurbsSurface& surface, const Eigen::VectorXd& step) const {
    std::vector<Eigen::Vector3d> points = surface.control_points();
    for (int i = 0; i < surface.count_u(); ++i) {
      for (int j = 0; j < rows_; ++j) {
        for (const Term& term : terms(i, j)) {
          points[static_cast<std::size_t>(i * rows_ + j)] += term.factor * step.segment<3>(3 * term.unknown);
        }
      }
    }
    return NurbsSurface(surface.u(), surface.v(), std::move(points), surface.weights());
  }

 private:
  std::size_t At(int i, int j) const { return static_cast<std::size_t>(i * rows_ + j); }

  int columns_, rows_, unknowns_ = 0;
  std::vector<Terms> terms_;
};

// One Gauss–Newton step; `feet` are those of the samples.
Eigen::VectorXd StepToSamples(const RefitProblem& problem, const NurbsSurface& surface,
                              const SurfaceCells& cells, const std::vector<Eigen::Vector3d>& samples,
                              const std::vector<Eigen::Vector2d>& feet) {
  const BSplineBasis &bu = surface.u(), &bv = surface.v();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right(3 * static_cast<Eigen::Index>(samples.size()));
  std::array<double, kMaxDegree + 1> nu, nv;
  Eigen::Index row = 0;
  // Three rows: `axes` times the surface's point at (u, v) less the sample.
  const auto add = [&](double u, double v, const Eigen::Matrix3d& axes, const Eigen::Vector3d& missing) {
    right.segment<3>(row) = axes * missing;
    const int su = bu.FindSpan(u), sv = bv.FindSpan(v);
    bu.Evaluate(su, u, 0, nu.data());
    bv.Evaluate(sv, v, 0, nv.data());
    const double denominator = cells.Denominator(u, v);
    for (int a = 0; a <= bu.degree(); ++a) {
      for (int b = 0; b <= bv.degree(); ++b) {
        const int i = su - bu.degree() + a, j = sv - bv.degree() + b;
        const double value = nu[static_cast<std::size_t>(a)] * nv[static_cast<std::size_t>(b)] *
                             surface.weight(i, j) / denominator;
        for (const Term& term : problem.terms(i, j)) {
          for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
              if (axes(r, c) == 0) continue;
              entries.emplace_back(row + r, 3 * term.unknown + c, value * term.factor * axes(r, c));
            }
          }
        }
      }
    }
    row += 3;
  };
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SurfaceCells::Jet1 jet = cells.Evaluate1(feet[k][0], feet[k][1]);
    Eigen::Matrix3d axes;  // rows: across, and two along the surface
    Eigen::Vector3d normal = jet.du.cross(jet.dv);
    normal = normal.norm() > 0 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d::UnitZ();
    axes.row(0) = normal;
    axes.row(1) = kTangential * normal.unitOrthogonal();
    axes.row(2) = kTangential * normal.cross(normal.unitOrthogonal());
    add(feet[k][0], feet[k][1], axes, samples[k] - jet.position);
  }
  Eigen::SparseMatrix<double> matrix(right.size(), 3 * problem.unknowns());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> normal_matrix = Eigen::SparseMatrix<double>(matrix.transpose()) * matrix;
  const double ridge = 1e-10 * normal_matrix.diagonal().sum() / (3.0 * problem.unknowns());
  for (Eigen::Index k = 0; k < normal_matrix.cols(); ++k) normal_matrix.coeffRef(k, k) += ridge;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal_matrix);
  return factor.solve(matrix.transpose() * right);
}

}  // namespace

NurbsSurface RefitToSections(const Skin& skin, std::span<const NurbsCurve> sections,
                             const SkinOptions& options) {
  const RefitProblem problem(skin.surface, options);
  if (problem.unknowns() == 0) return skin.surface;
  std::vector<Eigen::Vector3d> samples;
  std::vector<Eigen::Vector2d> feet;
  for (std::size_t l = 0; l < sections.size(); ++l) {
    const BSplineBasis& basis = sections[l].basis();
    const int count = kSamplesPerControlPoint * basis.num_distinct_control_points();
    for (int k = 0; k < count; ++k) {
      const double u =
          basis.periodic() ? static_cast<double>(k) / count : static_cast<double>(k) / (count - 1);
      samples.push_back(sections[l].Evaluate(basis.begin() + u * (basis.end() - basis.begin())));
      feet.emplace_back(u, skin.v[l]);
    }
  }
  NurbsSurface surface = skin.surface;
  SurfaceCells cells(surface);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const FootPoint foot = RefineFootPoint(cells, samples[k], feet[k][0], feet[k][1], {});
      feet[k] = {foot.u, foot.v};
    }
    const Eigen::VectorXd step = StepToSamples(problem, surface, cells, samples, feet);
    if (!step.allFinite()) break;
    surface = problem.Moved(surface, step);
    cells.Update(surface.control_points(), surface.weights());
    if (step.lpNorm<Eigen::Infinity>() < kSmallestStep * surface.Size()) break;
  }
  return surface;
}

}  // namespace frond
