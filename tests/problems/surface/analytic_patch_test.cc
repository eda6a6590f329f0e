// SPDX-License-Identifier: BSD-3-Clause
// Patches of quadrics and tori: the sampler, and that the fit finds them exactly from points without noise.
#include "problems/surface/analytic_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "problems/surface/principal_axes.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

TEST(AnalyticPatch, CleanPoints_LieOnTheShapeAndNoiseIsAsAskedFor) {
  for (std::size_t s = 0; s < AnalyticShapeNames().size(); ++s) {
    const AnalyticPatch patch{.shape = static_cast<AnalyticShape>(s)};
    const AnalyticScan scan = ScanAnalyticPatch(patch, {.points = 5000, .noise = 0.1, .seed = 3});
    const Eigen::Isometry3d back = scan.pose.inverse();
    double squared = 0;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      ASSERT_LT(patch.Distance(back * scan.clean_points[i]), 1e-10);
      squared += std::pow(patch.Distance(back * scan.points[i]), 2);
    }
    EXPECT_NEAR(std::sqrt(squared / 5000), 0.1, 0.004) << AnalyticShapeNames()[s];
    EXPECT_EQ(ScanAnalyticPatch(patch, {.points = 5000, .noise = 0.1, .seed = 3}).points, scan.points);
    EXPECT_NE(ScanAnalyticPatch(patch, {.points = 5000, .noise = 0.1, .seed = 4}).points, scan.points);
  }
}

TEST(AnalyticPatch, ATubeWiderThanItsRing_IsRefused) {
  Options options(AnalyticPatchSpecs(AnalyticShape::kTorus));
  options.Set("tube_radius", 31.0);
  EXPECT_THROW(AnalyticPatchFrom(AnalyticShape::kTorus, options), ConfigError);
}

struct Case {
  AnalyticShape shape;
  double angle;
  int net;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << AnalyticShapeNames()[static_cast<std::size_t>(c.shape)] << " " << c.angle << " " << c.net;
}

SurfaceFit FitPatch(const AnalyticScan& scan, int net) {
  const PrincipalAxes axes = FindPrincipalAxes(scan.points, std::vector<std::uint8_t>(scan.points.size(), 0));
  std::vector<Eigen::Vector3d> local;
  for (const auto& point : scan.points) local.push_back(axes.axes.transpose() * (point - axes.origin));
  SurfaceFitOptions options;
  options.degree = {2, 2};
  options.control_points = {net, net};
  options.unknowns = SurfaceUnknowns::kBoth;
  options.margin = MarginMode::kNone;
  options.start_from_ma = true;
  const SolverType& type = FindSolverType("lm");
  Options lm(type.options);
  for (const auto& [name, value] : SurfaceFitSolverDefaults("lm", options)) lm.Set(name, value);
  lm.Set("max_iterations", std::int64_t{60});  // as configs/objects/cone.yaml
  lm.Set("initial_trust_region_radius", 1e4);
  lm.Set("function_tolerance", 1e-9);
  return FitSurface(local, {}, std::nullopt, options, *type.create(lm), {}, {});
}

class ExactFit : public ::testing::TestWithParam<Case> {};

TEST_P(ExactFit, OfAPatchWithoutNoise_IsBelowAMillionthOfItsSize) {
  const Case& c = GetParam();
  const AnalyticPatch patch{.shape = c.shape, .angle = c.angle, .profile_angle = 0.9 * c.angle};
  const AnalyticScan scan = ScanAnalyticPatch(patch, {.points = 1500});
  const SurfaceFit fit = FitPatch(scan, c.net);
  Eigen::AlignedBox3d box;
  for (const auto& point : scan.points) box.extend(point);
  const double size = box.diagonal().norm();
  EXPECT_LT(fit.quality.max, 1e-6 * size);
  EXPECT_LT(fit.quality.reverse_p95, 0.1 * size);  // and is not far longer than the data
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_EQ(std::count(fit.outlier.begin(), fit.outlier.end(), 1), 0);
  RecordProperty("max_over_size_times_1e9", std::to_string(1e9 * fit.quality.max / size));
}

INSTANTIATE_TEST_SUITE_P(
    Patches, ExactFit,
    ::testing::Values(Case{AnalyticShape::kCylinder, 60, 3}, Case{AnalyticShape::kCylinder, 90, 3},
                      Case{AnalyticShape::kCylinder, 120, 3}, Case{AnalyticShape::kCylinder, 90, 5},
                      Case{AnalyticShape::kCone, 60, 3}, Case{AnalyticShape::kCone, 90, 3},
                      Case{AnalyticShape::kCone, 120, 3}, Case{AnalyticShape::kCone, 90, 5},
                      Case{AnalyticShape::kSphere, 60, 3}, Case{AnalyticShape::kSphere, 90, 3},
                      Case{AnalyticShape::kSphere, 110, 3}, Case{AnalyticShape::kSphere, 70, 5},
                      Case{AnalyticShape::kTorus, 60, 3}, Case{AnalyticShape::kTorus, 90, 3},
                      Case{AnalyticShape::kTorus, 100, 3}, Case{AnalyticShape::kTorus, 90, 5}));

TEST(ExactFit, WithNoise_StaysAtTheNoise) {
  const AnalyticPatch patch{.shape = AnalyticShape::kCone};
  const AnalyticScan scan = ScanAnalyticPatch(patch, {.points = 3000, .noise = 0.05});
  const SurfaceFit fit = FitPatch(scan, 5);
  EXPECT_NEAR(fit.quality.rmse, 0.05, 0.003);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
}

}  // namespace
}  // namespace frond
