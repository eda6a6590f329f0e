// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/errors.h"
#include "problems/surface/surface_fit.h"

namespace frond {
namespace {

TEST(SurfaceFitOptions, OfAnEmptyConfig_AreTheDefaults) {
  const SurfaceFitOptions read = SurfaceFitOptionsFrom(Options(SurfaceFitSpecs())), defaults;
  EXPECT_EQ(read.degree, defaults.degree);
  EXPECT_EQ(read.control_points, defaults.control_points);
  EXPECT_EQ(read.unknowns, defaults.unknowns);
  EXPECT_EQ(read.margin, defaults.margin);
  EXPECT_EQ(read.derivatives, defaults.derivatives);
  EXPECT_EQ(read.fairness, defaults.fairness);
  EXPECT_EQ(read.hinge, defaults.hinge);
  EXPECT_EQ(read.hinge_limit, defaults.hinge_limit);
  EXPECT_EQ(read.loss, defaults.loss);
  EXPECT_EQ(read.loss_scale, defaults.loss_scale);
  EXPECT_EQ(read.outlier_threshold, defaults.outlier_threshold);
  EXPECT_EQ(read.margin_weight, defaults.margin_weight);
  EXPECT_EQ(read.subset, defaults.subset);
}

TEST(SurfaceFitOptions, AreReadFromAConfig) {
  using List = std::vector<double>;
  Options options(SurfaceFitSpecs());
  options.Set("surface.degree", List{2, 4});
  options.Set("surface.control_points", List{7, 12});
  options.Set("fit.unknowns", std::string("both"));
  options.Set("fit.margin", std::string("conforming"));
  options.Set("fit.derivatives", std::string("autodiff"));
  options.Set("fit.fairness", 1e-7);
  options.Set("fit.loss", std::string("huber"));
  options.Set("fit.subset", std::int64_t{5000});
  const SurfaceFitOptions read = SurfaceFitOptionsFrom(options);
  EXPECT_EQ(read.degree, (std::array<int, 2>{2, 4}));
  EXPECT_EQ(read.control_points, (std::array<int, 2>{7, 12}));
  EXPECT_EQ(read.unknowns, SurfaceUnknowns::kBoth);
  EXPECT_EQ(read.margin, MarginMode::kConforming);
  EXPECT_EQ(read.derivatives, DistanceDerivatives::kAutodiff);
  EXPECT_EQ(read.fairness, 1e-7);
  EXPECT_EQ(read.loss, "huber");
  EXPECT_EQ(read.subset, 5000);
}

TEST(SurfaceFitOptions, AutoNet_IsZeroByZero) {
  Options options(SurfaceFitSpecs());
  options.Set("surface.control_points", std::string("auto"));
  EXPECT_EQ(SurfaceFitOptionsFrom(options).control_points, (std::array<int, 2>{0, 0}));
}

TEST(SurfaceFitOptions, OutOfRange_AreRefusedByName) {
  Options options(SurfaceFitSpecs());
  EXPECT_THROW(options.Set("surface.degree", std::vector<double>{3, 13}), ConfigError);
  EXPECT_THROW(options.Set("surface.control_points", std::vector<double>{1, 20}), ConfigError);
  EXPECT_THROW(options.Set("fit.hinge_limit", 1.5), ConfigError);
  EXPECT_THROW(options.Set("fit.margin", std::string("trimmed")), ConfigError);
}

TEST(MarginFor, CoarseNets_Conform_AndFineOnesAreTrimmed) {
  SurfaceFitOptions options;
  EXPECT_EQ(MarginFor(options, {5, 5}), MarginMode::kConforming);
  EXPECT_EQ(MarginFor(options, {7, 7}), MarginMode::kConforming);
  EXPECT_EQ(MarginFor(options, {5, 8}), MarginMode::kTrim);
  options.margin = MarginMode::kNone;
  EXPECT_EQ(MarginFor(options, {5, 5}), MarginMode::kNone);
}

TEST(SurfaceFitSolverDefaults, AreOptionsThatTheSolverKnows) {
  for (const SolverType& type : SolverTypes()) {
    Options options(type.options);
    for (const auto& [name, value] : SurfaceFitSolverDefaults(type.name, {})) {
      EXPECT_NO_THROW(options.Set(name, value)) << type.name << ' ' << name;
    }
  }
}

}  // namespace
}  // namespace frond
