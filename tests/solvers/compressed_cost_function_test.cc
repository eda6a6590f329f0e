// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/compressed_cost_function.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"

namespace frond {
namespace {

struct Rows {
  Eigen::MatrixXd A;
  Eigen::VectorXd r;
};

Rows RandomRows(int m, int size, std::uint64_t seed) {
  Random random(seed);
  Rows rows{Eigen::MatrixXd(m, size), Eigen::VectorXd(m)};
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < size; ++j) rows.A(i, j) = random.Normal();
    rows.r[i] = random.Normal();
  }
  return rows;
}

CompressedRows Accumulate(const Rows& rows, const RobustLoss& loss = {}) {
  CompressedRows sums(static_cast<int>(rows.A.cols()));
  for (Eigen::Index i = 0; i < rows.A.rows(); ++i) {
    const Eigen::VectorXd a = rows.A.row(i);
    sums.AddRow({a.data(), static_cast<std::size_t>(a.size())}, rows.r[i], loss);
  }
  return sums;
}

// What Ceres sees of a CompressedBlock over one parameter block.
struct Seen {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  double Cost() const { return residual.squaredNorm() / 2; }
  Eigen::VectorXd Gradient() const { return jacobian.transpose() * residual; }
  Eigen::MatrixXd GaussNewton() const { return jacobian.transpose() * jacobian; }
};

Seen Evaluate(const CompressedBlock& block) {
  const int size = static_cast<int>(block.jacobian.cols());
  const CompressedCostFunction cost(&block, {size});
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(size + 1, size);
  Seen seen{Eigen::VectorXd(size + 1), {}};
  double* jacobians[] = {jacobian.data()};
  EXPECT_TRUE(cost.Evaluate(nullptr, seen.residual.data(), jacobians));
  seen.jacobian = jacobian;
  return seen;
}

// Equal to `tolerance`, relative to the largest entry.
void ExpectClose(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected, double tolerance) {
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance * expected.cwiseAbs().maxCoeff());
}

void ExpectSame(const Rows& rows, double tolerance = 1e-12) {
  CompressedBlock block;
  ASSERT_TRUE(Accumulate(rows).Compress(&block));
  const Seen seen = Evaluate(block);
  EXPECT_NEAR(seen.Cost(), rows.r.squaredNorm() / 2, tolerance * rows.r.squaredNorm());
  ExpectClose(seen.Gradient(), rows.A.transpose() * rows.r, tolerance);
  ExpectClose(seen.GaussNewton(), rows.A.transpose() * rows.A, tolerance);
}

TEST(CompressedRows, ManyRows_KeepCostGradientAndGaussNewtonMatrix) {
  for (const int size : {1, 3, 12, 48}) ExpectSame(RandomRows(4 * size + 100, size, 1));
}

TEST(CompressedRows, FewerRowsThanParameters_KeepThemToo) {
  for (const int m : {1, 2, 7}) ExpectSame(RandomRows(m, 12, 2));
}

TEST(CompressedRows, RankDeficientRows_KeepThemToo) {
  Rows rows = RandomRows(200, 12, 3);
  rows.A.col(5) = rows.A.col(2) - 3 * rows.A.col(7);
  rows.A.col(11) = rows.A.col(0);
  ExpectSame(rows);
}

TEST(CompressedRows, ParameterWithoutRows_HasAZeroColumn) {
  Rows rows = RandomRows(50, 6, 4);
  rows.A.col(0).setZero();
  rows.A.col(4).setZero();
  ExpectSame(rows);
  CompressedBlock block;
  ASSERT_TRUE(Accumulate(rows).Compress(&block));
  EXPECT_EQ(Evaluate(block).jacobian.col(4).norm(), 0);
}

TEST(CompressedRows, NoRows_AreAZeroBlock) {
  CompressedBlock block;
  ASSERT_TRUE(CompressedRows(4).Compress(&block));
  const Seen seen = Evaluate(block);
  EXPECT_EQ(seen.residual.norm(), 0);
  EXPECT_EQ(seen.jacobian.norm(), 0);
}

TEST(CompressedRows, OnlyAConstantRow_KeepsItsCost) {
  CompressedRows sums(3);
  const std::array<double, 3> zero{};
  sums.AddRow(zero, 2.0);
  CompressedBlock block;
  ASSERT_TRUE(sums.Compress(&block));
  EXPECT_DOUBLE_EQ(Evaluate(block).Cost(), 2.0);
}

TEST(CompressedRows, ParametersOfVeryDifferentUnits_KeepEachItsCurvature) {
  // A jitter of the mean diagonal would drown the small parameters: compare entry by entry.
  Rows rows = RandomRows(100, 4, 5);
  const Eigen::Vector4d units(1e8, 1, 1e-6, 1e-10);
  rows.A = rows.A * units.asDiagonal();
  CompressedBlock block;
  ASSERT_TRUE(Accumulate(rows).Compress(&block));
  const Eigen::MatrixXd H = rows.A.transpose() * rows.A;
  const Eigen::MatrixXd seen = Evaluate(block).GaussNewton();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(seen(i, j), H(i, j), 1e-12 * std::sqrt(H(i, i) * H(j, j)));
    }
  }
}

TEST(CompressedRows, ExactFit_HasNoNegativeRest) {
  Rows rows = RandomRows(60, 5, 6);
  rows.r = rows.A * Eigen::VectorXd::LinSpaced(5, -1, 2);  // r lies in the range of A: the rest is rounding
  ExpectSame(rows);
}

TEST(CompressedRows, Weight_CountsAsThatManyRows) {
  const Rows rows = RandomRows(20, 3, 7);
  CompressedRows weighted(3), repeated(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d a = rows.A.row(i);
    weighted.AddRow({a.data(), 3}, rows.r[i], 3.0);
    for (int k = 0; k < 3; ++k) repeated.AddRow({a.data(), 3}, rows.r[i]);
  }
  ExpectClose(weighted.H(), repeated.H(), 1e-14);
  ExpectClose(weighted.g(), repeated.g(), 1e-14);
  EXPECT_NEAR(weighted.squared_norm(), repeated.squared_norm(), 1e-13);
}

TEST(CompressedRows, AddMatrix_AddsRowsAccumulatedElsewhere) {
  const Rows rows = RandomRows(40, 6, 8);
  CompressedRows sums = Accumulate({rows.A.topRows(25), rows.r.head(25)});
  const Eigen::MatrixXd rest = rows.A.bottomRows(15);
  const Eigen::VectorXd rest_r = rows.r.tail(15);
  sums.AddMatrix(rest.transpose() * rest, rest.transpose() * rest_r, rest_r.squaredNorm());
  const CompressedRows all = Accumulate(rows);
  ExpectClose(sums.H(), all.H(), 1e-14);
  ExpectClose(sums.g(), all.g(), 1e-13);
  EXPECT_NEAR(sums.squared_norm(), all.squared_norm(), 1e-12);
  sums.Reset();
  EXPECT_EQ(sums.H().norm() + sums.g().norm() + sums.squared_norm(), 0);
}

TEST(CompressedRows, LowerTriangle_IsNotRead) {
  const Rows rows = RandomRows(40, 5, 9);
  CompressedRows sums = Accumulate(rows);
  sums.H().triangularView<Eigen::StrictlyLower>().setConstant(std::nan(""));
  CompressedBlock block;
  ASSERT_TRUE(sums.Compress(&block));
  ExpectClose(Evaluate(block).GaussNewton(), rows.A.transpose() * rows.A, 1e-12);
}

TEST(CompressedRows, ValueNotFinite_IsRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    Rows rows = RandomRows(10, 3, 10);
    rows.A(4, 1) = bad;
    CompressedBlock block;
    EXPECT_FALSE(Accumulate(rows).Compress(&block));
    EXPECT_FALSE(block.factored);
    rows = RandomRows(10, 3, 10);
    rows.r[4] = bad;
    EXPECT_FALSE(Accumulate(rows).Compress(&block));
  }
}

TEST(CompressedCostFunction, CostOnly_NeedsNoFactor) {
  CompressedBlock block;
  SetCostOnly(9.0, &block);
  const CompressedCostFunction cost(&block, {2, 3});
  EXPECT_EQ(cost.num_residuals(), 6);
  Eigen::VectorXd residual(6);
  EXPECT_TRUE(cost.Evaluate(nullptr, residual.data(), nullptr));
  EXPECT_DOUBLE_EQ(residual.squaredNorm(), 9.0);

  Eigen::MatrixXd jacobian(6, 5);
  double* jacobians[] = {jacobian.data(), jacobian.data() + 12};
  EXPECT_FALSE(cost.Evaluate(nullptr, residual.data(), jacobians)) << "a block of other parameters";
  SetCostOnly(std::nan(""), &block);
  EXPECT_FALSE(cost.Evaluate(nullptr, residual.data(), nullptr));
}

TEST(CompressedCostFunction, SeveralParameterBlocks_GetTheirColumns) {
  const Rows rows = RandomRows(30, 6, 11);
  CompressedBlock block;
  ASSERT_TRUE(Accumulate(rows).Compress(&block));
  const Eigen::MatrixXd whole = Evaluate(block).jacobian;
  const CompressedCostFunction cost(&block, {1, 3, 2});
  Eigen::VectorXd residual(7);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor first(7, 1), last(7, 2);
  double* jacobians[] = {first.data(), nullptr, last.data()};  // the second block is constant
  ASSERT_TRUE(cost.Evaluate(nullptr, residual.data(), jacobians));
  EXPECT_EQ(first, whole.col(0));
  EXPECT_EQ(last, whole.rightCols(2));
}

// A decay a exp(−b t) + c against samples with outliers, in blocks (a, b) and c.
struct DecayResidual {
  static double Sample(int i) {
    return 2 * std::exp(-0.3 * i * 0.1) + 0.5 + (i % 11 == 0 ? 1.5 : 0.01 * (i % 3));
  }

  template <typename T>
  bool operator()(int i, const T* decay, const T* level, T* residual) const {
    using std::exp;
    residual[0] = decay[0] * exp(-decay[1] * (0.1 * i)) + level[0] - Sample(i);
    return true;
  }
};

struct OneDecayResidual {
  int i;

  template <typename T>
  bool operator()(const T* decay, const T* level, T* residual) const {
    return DecayResidual()(i, decay, level, residual);
  }
};

// Two rows a sample, with the loss on their joint norm.
struct SpiralResidual {
  template <typename T>
  bool operator()(int i, const T* spiral, T* residual) const {
    using std::cos;
    using std::sin;
    residual[0] = spiral[0] * cos(spiral[1] * static_cast<double>(i)) - (i % 5 == 0 ? 4.0 : 1.0);
    residual[1] = spiral[0] * sin(spiral[1] * static_cast<double>(i)) - 0.2;
    return true;
  }
};

struct OneSpiralResidual {
  int i;

  template <typename T>
  bool operator()(const T* spiral, T* residual) const {
    return SpiralResidual()(i, spiral, residual);
  }
};

struct FailsAtTheFourth {
  template <typename T>
  bool operator()(int i, const T* x, T* residual) const {
    residual[0] = x[0];
    return i < 3;
  }
};

struct Linearised {
  double cost = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd gauss_newton;
};

// Everything that a Gauss–Newton method learns of a problem, loss functions applied by Ceres.
Linearised Linearise(ceres::Problem* problem) {
  Linearised result;
  std::vector<double> gradient;
  ceres::CRSMatrix crs;
  EXPECT_TRUE(problem->Evaluate({}, &result.cost, nullptr, &gradient, &crs));
  result.gradient = Eigen::VectorXd::Map(gradient.data(), static_cast<Eigen::Index>(gradient.size()));
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int i = 0; i < crs.num_rows; ++i) {
    for (int k = crs.rows[i]; k < crs.rows[i + 1]; ++k) J(i, crs.cols[k]) = crs.values[k];
  }
  result.gauss_newton = J.transpose() * J;
  return result;
}

void ExpectSame(ceres::Problem* compressed, ceres::Problem* plain) {
  const Linearised actual = Linearise(compressed), expected = Linearise(plain);
  EXPECT_NEAR(actual.cost, expected.cost, 1e-12 * expected.cost);
  ExpectClose(actual.gradient, expected.gradient, 1e-12);
  ExpectClose(actual.gauss_newton, expected.gauss_newton, 1e-12);
  double cost_only = 0;
  ASSERT_TRUE(compressed->Evaluate({}, &cost_only, nullptr, nullptr, nullptr));
  EXPECT_NEAR(cost_only, expected.cost, 1e-12 * expected.cost);
}

TEST(CompressedAutoDiffCostFunction, EveryLoss_EqualsPlainBlocksWithCeresLoss) {
  constexpr int kSamples = 100;
  for (const std::string& name : RobustLossNames()) {
    const RobustLoss loss = MakeRobustLoss(name, 0.2);
    double decay[2] = {1.7, 0.5}, level[1] = {0.3};
    ceres::Problem compressed, plain;
    compressed.AddResidualBlock(
        new CompressedAutoDiffCostFunction<DecayResidual, 1, 2, 1>(DecayResidual(), kSamples, loss), nullptr,
        decay, level);
    for (int i = 0; i < kSamples; ++i) {
      plain.AddResidualBlock(
          new ceres::AutoDiffCostFunction<OneDecayResidual, 1, 2, 1>(new OneDecayResidual{i}),
          MakeCeresLoss(loss).release(), decay, level);
    }
    SCOPED_TRACE(name);
    ExpectSame(&compressed, &plain);
  }
}

TEST(CompressedAutoDiffCostFunction, GroupsOfRows_ShareTheirLossAsABlockDoes) {
  constexpr int kSamples = 40;
  const RobustLoss loss = MakeRobustLoss("cauchy", 0.5);
  double spiral[2] = {1.3, 0.2};
  ceres::Problem compressed, plain;
  compressed.AddResidualBlock(
      new CompressedAutoDiffCostFunction<SpiralResidual, 2, 2>(SpiralResidual(), kSamples, loss), nullptr,
      spiral);
  for (int i = 0; i < kSamples; ++i) {
    plain.AddResidualBlock(new ceres::AutoDiffCostFunction<OneSpiralResidual, 2, 2>(new OneSpiralResidual{i}),
                           MakeCeresLoss(loss).release(), spiral);
  }
  ExpectSame(&compressed, &plain);
}

TEST(CompressedAutoDiffCostFunction, Solve_TakesTheSameStepsAsPlainBlocks) {
  constexpr int kSamples = 100;
  const RobustLoss loss = MakeRobustLoss("huber", 0.1);
  const auto solve = [&](bool compress) {
    std::array<double, 3> x = {1, 1, 0};
    ceres::Problem problem;
    if (compress) {
      problem.AddResidualBlock(
          new CompressedAutoDiffCostFunction<DecayResidual, 1, 2, 1>(DecayResidual(), kSamples, loss),
          nullptr, &x[0], &x[2]);
    }
    for (int i = 0; i < kSamples && !compress; ++i) {
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<OneDecayResidual, 1, 2, 1>(new OneDecayResidual{i}),
          MakeCeresLoss(loss).release(), &x[0], &x[2]);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.max_num_iterations = 6;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return x;
  };
  const auto compressed = solve(true), plain = solve(false);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(compressed[k], plain[k], 1e-9);
}

TEST(CompressedAutoDiffCostFunction, FunctorThatFails_FailsTheEvaluation) {
  const CompressedAutoDiffCostFunction<FailsAtTheFourth, 1, 1> cost(FailsAtTheFourth(), 4);
  const double x = 1;
  const double* parameters[] = {&x};
  double residual[2], jacobian[2];
  double* jacobians[] = {jacobian};
  EXPECT_FALSE(cost.Evaluate(parameters, residual, nullptr));
  EXPECT_FALSE(cost.Evaluate(parameters, residual, jacobians));
}

}  // namespace
}  // namespace frond
