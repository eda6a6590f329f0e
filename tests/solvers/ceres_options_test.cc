// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/ceres_options.h"

#include <gtest/gtest.h>

#include <string>

#include "base/errors.h"

namespace frond {
namespace {

TEST(CeresOptions, Defaults_AreValidForCeres) {
  for (const CeresMethod method :
       {CeresMethod::kLevenbergMarquardt, CeresMethod::kDogleg, CeresMethod::kLbfgs}) {
    const ceres::Solver::Options options = CeresOptionsFrom(Options(CeresOptionSpecs(method)), 2, method);
    std::string error;
    EXPECT_TRUE(options.IsValid(&error)) << error;
    EXPECT_EQ(options.num_threads, 2);
    EXPECT_EQ(options.logging_type, ceres::SILENT);
  }
}

TEST(CeresOptions, EveryChoice_IsValidForCeres) {
  for (const CeresMethod method :
       {CeresMethod::kLevenbergMarquardt, CeresMethod::kDogleg, CeresMethod::kLbfgs}) {
    for (const OptionSpec& spec : CeresOptionSpecs(method)) {
      for (const std::string& word : spec.words) {
        Options options(CeresOptionSpecs(method));
        options.Set(spec.name, word);
        std::string error;
        EXPECT_TRUE(CeresOptionsFrom(options, 1, method).IsValid(&error)) << spec.name << ": " << error;
      }
      for (const double bound : {spec.minimum, spec.maximum}) {
        if (spec.type != OptionType::kInteger && spec.type != OptionType::kNumber) continue;
        Options options(CeresOptionSpecs(method));
        options.Set(spec.name, bound);
        std::string error;
        EXPECT_TRUE(CeresOptionsFrom(options, 1, method).IsValid(&error)) << spec.name << ": " << error;
      }
    }
  }
}

TEST(CeresOptions, Values_ReachCeres) {
  Options options(CeresOptionSpecs(CeresMethod::kDogleg));
  options.Set("initial_trust_region_radius", 1.0);
  options.Set("max_iterations", 7);
  options.Set("function_tolerance", 1e-3);
  options.Set("gradient_tolerance", 1e-4);
  options.Set("parameter_tolerance", 1e-5);
  options.Set("linear_solver", std::string("sparse_normal_cholesky"));
  options.Set("nonmonotonic_steps", true);
  options.Set("dogleg_type", std::string("subspace"));
  const ceres::Solver::Options seen = CeresOptionsFrom(options, 1, CeresMethod::kDogleg);
  EXPECT_EQ(seen.minimizer_type, ceres::TRUST_REGION);
  EXPECT_EQ(seen.trust_region_strategy_type, ceres::DOGLEG);
  EXPECT_EQ(seen.initial_trust_region_radius, 1.0);
  EXPECT_EQ(seen.max_num_iterations, 7);
  EXPECT_EQ(seen.function_tolerance, 1e-3);
  EXPECT_EQ(seen.gradient_tolerance, 1e-4);
  EXPECT_EQ(seen.parameter_tolerance, 1e-5);
  EXPECT_EQ(seen.linear_solver_type, ceres::SPARSE_NORMAL_CHOLESKY);
  EXPECT_EQ(seen.sparse_linear_algebra_library_type, ceres::SUITE_SPARSE);
  EXPECT_TRUE(seen.use_nonmonotonic_steps);
  EXPECT_EQ(seen.dogleg_type, ceres::SUBSPACE_DOGLEG);
}

TEST(CeresOptions, Lbfgs_HasNoTrustRegion) {
  Options options(CeresOptionSpecs(CeresMethod::kLbfgs));
  options.Set("lbfgs_rank", 5);
  EXPECT_EQ(CeresOptionsFrom(options, 1, CeresMethod::kLbfgs).max_lbfgs_rank, 5);
  EXPECT_EQ(CeresOptionsFrom(options, 1, CeresMethod::kLbfgs).line_search_type, ceres::WOLFE);
  EXPECT_THROW(options.Set("linear_solver", std::string("dense_qr")), ConfigError);
  EXPECT_THROW(options.Set("lbfgs_rank", 0), ConfigError);
}

}  // namespace
}  // namespace frond
