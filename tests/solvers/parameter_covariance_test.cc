// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/parameter_covariance.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "base/errors.h"

namespace frond {
namespace {

// a + b t + c t² − y, over blocks (a, b) and c.
struct ParabolaResidual {
  double t;

  template <typename T>
  bool operator()(const T* line, const T* bend, T* residual) const {
    residual[0] = line[0] + t * line[1] + t * t * bend[0];
    return true;
  }
};

class Parabola final : public FitProblem {
 public:
  explicit Parabola(std::vector<double> times) : times_(std::move(times)) {}

  const std::vector<ParameterBlock>& parameters() const override { return blocks; }
  void AddResiduals(const std::vector<double*>& values, ceres::EvaluationCallback* /*state*/,
                    ceres::Problem* problem) const override {
    for (const double t : times_) {
      problem->AddResidualBlock(
          new ceres::AutoDiffCostFunction<ParabolaResidual, 1, 2, 1>(new ParabolaResidual{t}), nullptr,
          values[0], values[1]);
    }
  }

  std::vector<ParameterBlock> blocks = {{.name = "line", .start = {1, 2}}, {.name = "bend", .start = {3}}};

 private:
  std::vector<double> times_;
};

TEST(ParameterCovarianceTest, LinearFit_HasTheInverseOfItsNormalMatrix) {
  Parabola fit({0, 1, 2, 3, 1000});
  Eigen::Matrix<double, 5, 3> A;
  const double times[] = {0, 1, 2, 3, 1000};
  for (int i = 0; i < 5; ++i) A.row(i) << 1, times[i], times[i] * times[i];
  const Eigen::Matrix3d expected = (A.transpose() * A).inverse();
  const Eigen::MatrixXd found = UnitCovariance(fit, fit.StartVector());
  EXPECT_TRUE(found.isApprox(expected, 1e-6)) << found << "\n" << expected;
}

TEST(ParameterCovarianceTest, HeldValues_HaveNoVarianceAndGiveTheOthersTheirs) {
  Parabola fit({0, 1, 2, 3});
  fit.blocks[1].constant = true;
  fit.blocks[0].manifold = std::make_shared<ceres::SubsetManifold>(2, std::vector<int>{0});
  const Eigen::MatrixXd found = UnitCovariance(fit, fit.StartVector());
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(1, 1) = 1.0 / (0 + 1 + 4 + 9);
  EXPECT_TRUE(found.isApprox(expected, 1e-12)) << found;
}

TEST(ParameterCovarianceTest, Parameters_ThatTheDataDoNotDetermine_AreNamed) {
  const Parabola fit({1, 2});
  try {
    UnitCovariance(fit, fit.StartVector());
    FAIL();
  } catch (const FitError& error) {
    EXPECT_NE(std::string(error.what()).find("do not determine"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace frond
