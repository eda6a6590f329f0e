// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/thin_plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

// ∫ N_a^(d) N_c^(d) over span k for d = 0, 1, 2, in a parameter whose domain has length 1. From the
// functions' powers: the integrals of s^m s^n over [0, 1] are exact.
std::array<Eigen::MatrixXd, 3> SpanGram(const SpanPolynomials& spans, int k, double domain) {
  const Eigen::Index n = spans.degree() + 1;
  std::array<Eigen::MatrixXd, 3> gram;
  Eigen::MatrixXd c = spans.coefficients(k);
  const double length = spans.length(k) / domain;
  for (int d = 0; d < 3; ++d) {
    Eigen::MatrixXd integral(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) integral(i, j) = length / static_cast<double>(i + j + 1);
    }
    gram[static_cast<std::size_t>(d)] = c * integral * c.transpose();
    Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index m = 1; m < n; ++m) derivative.col(m - 1) = static_cast<double>(m) / length * c.col(m);
    c = derivative;
  }
  return gram;
}

// What the squared second derivatives by u count at v, a share of the domain.
double WeightAlongU(double v, PoleEnds poles) {
  if (!poles.any()) return 1;
  constexpr double kLeastSine = 0.08;
  const double turn = std::numbers::pi * (poles.begin && poles.end ? 1.0 : 0.5);
  const double s = std::max(kLeastSine, std::sin(turn * (poles.begin ? v : 1 - v)));
  return 1 / (s * s);
}

}  // namespace

std::vector<Eigen::MatrixXd> ThinPlateGram(const SurfaceCells& cells, PoleEnds poles, double membrane) {
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  std::vector<std::array<Eigen::MatrixXd, 3>> gu, gv;
  for (int k = 0; k < cells.u().count(); ++k) gu.push_back(SpanGram(cells.u(), k, bu.end() - bu.begin()));
  for (int k = 0; k < cells.v().count(); ++k) gv.push_back(SpanGram(cells.v(), k, bv.end() - bv.begin()));
  const Eigen::Index nu = cells.u().degree() + 1, nv = cells.v().degree() + 1;
  std::vector<Eigen::MatrixXd> grams;
  for (const auto& u : gu) {
    for (int kv = 0; kv < cells.v().count(); ++kv) {
      const auto& v = gv[static_cast<std::size_t>(kv)];
      const double middle =
          (cells.v().begin(kv) + 0.5 * cells.v().length(kv) - bv.begin()) / (bv.end() - bv.begin());
      const double along_u = WeightAlongU(middle, poles), mixed = std::sqrt(along_u);
      Eigen::MatrixXd gram(nu * nv, nu * nv);
      for (Eigen::Index i = 0; i < nu; ++i) {
        for (Eigen::Index k = 0; k < nu; ++k) {
          gram.block(i * nv, k * nv, nv, nv) = along_u * u[2](i, k) * v[0] + 2 * mixed * u[1](i, k) * v[1] +
                                               u[0](i, k) * v[2] +
                                               membrane * (u[1](i, k) * v[0] + u[0](i, k) * v[1]);
        }
      }
      grams.push_back(std::move(gram));
    }
  }
  return grams;
}

}  // namespace frond
