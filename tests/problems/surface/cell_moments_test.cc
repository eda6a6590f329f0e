// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/cell_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "base/random.h"
#include "models/surface_cells.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

struct Sizes {
  int degree_u, degree_v, components, right_hand_sides;
};

// H and g by their definition, from rows c ⊗ B and values r, and what CellMoments makes of the same points.
void ExpectPlainSum(const Sizes& sizes, double tolerance = 1e-12) {
  const auto [p, q, components, right_hand_sides] = sizes;
  Random random(static_cast<std::uint64_t>(100 * p + 10 * q + components));
  const SpanPolynomials su(UnevenBasis(p, p + 4, 0.5, 2)), sv(UnevenBasis(q, q + 3, -1, 0.7));
  const int ku = 1, kv = 2;
  const Eigen::Index local = (p + 1) * (q + 1);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(components * local, components * local);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(right_hand_sides * local);
  CellMoments moments(p, q, components, right_hand_sides);
  Eigen::VectorXd nu(p + 1), nv(q + 1), basis(local);
  for (int i = 0; i < 37; ++i) {
    const double s = random.Uniform(), t = random.Uniform();
    su.Evaluate(ku, su.begin(ku) + s * su.length(ku), 0, nu.data());
    sv.Evaluate(kv, sv.begin(kv) + t * sv.length(kv), 0, nv.data());
    for (int k = 0; k < local; ++k) basis[k] = nu[k / (q + 1)] * nv[k % (q + 1)];
    Eigen::MatrixXd cc = Eigen::MatrixXd::Zero(components, components);
    for (int row = 0; row <= i % 3; ++row) {
      Eigen::VectorXd c(components);
      for (double& value : c) value = random.Normal();
      cc += c * c.transpose();
    }
    Eigen::VectorXd cr(right_hand_sides);
    for (double& value : cr) value = random.Normal();
    std::vector<double> lower;
    for (int x = 0; x < components; ++x) {
      for (int y = 0; y <= x; ++y) lower.push_back(cc(x, y));
    }
    moments.Add(s, t, lower.data(), cr.data());
    for (Eigen::Index k = 0; k < local; ++k) {
      g.segment(k * right_hand_sides, right_hand_sides) += basis[k] * cr;
      for (Eigen::Index l = 0; l < local; ++l) {
        h.block(k * components, l * components, components, components) += basis[k] * basis[l] * cc;
      }
    }
  }
  // What is there already stays and is added to.
  Eigen::MatrixXd moments_h = Eigen::MatrixXd::Constant(h.rows(), h.cols(), 2);
  Eigen::VectorXd moments_g = Eigen::VectorXd::Constant(g.size(), -3);
  moments.AddTo(su.coefficients(ku), sv.coefficients(kv), &moments_h, &moments_g);
  moments_h.array() -= 2;
  moments_g.array() += 3;
  EXPECT_LE((moments_h - h).cwiseAbs().maxCoeff(), tolerance * h.cwiseAbs().maxCoeff()) << p << ' ' << q;
  EXPECT_LE((moments_g - g).cwiseAbs().maxCoeff(), tolerance * g.cwiseAbs().maxCoeff()) << p << ' ' << q;

  moments.Reset();
  moments_h.setZero();
  moments_g.setZero();
  moments.AddTo(su.coefficients(ku), sv.coefficients(kv), &moments_h, &moments_g);
  EXPECT_TRUE(moments_h.isZero(0));
  EXPECT_TRUE(moments_g.isZero(0));
}

TEST(CellMoments, AllDegrees_ThreeComponents_EqualThePlainSumOverRows) {
  for (int p = 1; p <= 5; ++p) {
    for (int q = 1; q <= 5; ++q) ExpectPlainSum({p, q, 3, 3});
  }
}

TEST(CellMoments, AllDegrees_HomogeneousComponents_EqualThePlainSumOverRows) {
  for (int p = 1; p <= 5; ++p) {
    for (int q = 1; q <= 5; ++q) ExpectPlainSum({p, q, 4, 4});
  }
}

TEST(CellMoments, HighDegrees_LoseNothingToCancellation) {
  ExpectPlainSum({8, 8, 3, 3}, 1e-11);
  ExpectPlainSum({12, 12, 3, 3}, 1e-9);
}

TEST(CellMoments, ScalarRowsWithThreeRightHandSides_EqualThePlainSum) {
  ExpectPlainSum({3, 3, 1, 3});
  ExpectPlainSum({2, 4, 1, 3});
  ExpectPlainSum({1, 5, 2, 7});
}

}  // namespace
}  // namespace frond
