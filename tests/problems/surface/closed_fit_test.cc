// SPDX-License-Identifier: BSD-3-Clause
// The distance fit of spheres, tubes and cups against the shapes that the points were drawn from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/random.h"
#include "models/enclosed_volume.h"
#include "models/surface_cells.h"
#include "problems/surface/surface_fit.h"
#include "tests/problems/surface/closed_clouds.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

using Points = std::vector<Eigen::Vector3d>;
constexpr double kNoise = 0.05;

SurfaceFitOptions OptionsFor(SurfaceTopology topology, std::array<int, 2> net) {
  SurfaceFitOptions options;
  options.topology = topology;
  options.control_points = net;
  options.subset = 2000;
  return options;
}

// Points a little outside are outside of the fit.
void ExpectOutwardNormals(const ClosedCloud& cloud, const NurbsSurface& surface) {
  Points outside;
  for (std::size_t i = 0; i < cloud.clean.size(); i += 5) {
    if (cloud.place[i][1] < 0.95 && cloud.place[i][1] > 0.05)
      outside.push_back(cloud.clean[i] + cloud.normals[i]);
  }
  for (const double d : MeasureDistances(outside, surface, 1).signed_distance) ASSERT_GT(d, 0);
  EXPECT_GT(EnclosedVolume(surface), 0);
}

// `most`: of any point. At a rim that was found points lie beyond the surface's end, by less than their
// spacing.
void ExpectGoodFit(const ClosedCloud& cloud, const SurfaceFit& fit, double most = 4 * kNoise) {
  const TruthErrors truth = ErrorsAgainst(cloud.clean, fit.surface.surface);
  EXPECT_LT(fit.quality.rmse, 1.1 * kNoise);
  EXPECT_LT(truth.rmse, 0.5 * kNoise);
  EXPECT_LT(truth.max, most);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_LE(std::count(fit.outlier.begin(), fit.outlier.end(), 1), 2);
  EXPECT_LT(fit.quality.reverse_max, 4 * fit.quality.point_spacing);
  EXPECT_TRUE(fit.surface.trim.empty());
  ExpectOutwardNormals(cloud, fit.surface.surface);
}

// The surface's end of v lies along the true rim, both ways.
void ExpectRimNear(const Ring& rim, const NurbsSurface& surface, bool end, double within) {
  Points ours;
  for (int k = 0; k < 200; ++k) ours.push_back(surface.Evaluate(k / 200.0, end ? 1 : 0));
  const auto farthest = [](const Points& from, const Points& to) {
    double most = 0;
    for (const auto& p : from) {
      double least = 1e9;
      for (const auto& q : to) least = std::min(least, (p - q).norm());
      most = std::max(most, least);
    }
    return most;
  };
  EXPECT_LT(farthest(rim, ours), within);
  EXPECT_LT(farthest(ours, rim), within);
}

TEST(ClosedFit, Ellipsoid_IsASphereWithSmoothPoles) {
  const ClosedCloud cloud = EllipsoidCloud({30, 22, 18}, 4000, kNoise);
  const SurfaceFit fit = FitLeaf(cloud.points, OptionsFor(SurfaceTopology::kSphere, {12, 10}));
  ExpectGoodFit(cloud, fit);
  const PoleEnds poles = SurfaceCells(fit.surface.surface).poles();
  EXPECT_TRUE(poles.begin && poles.end);
  const double volume = 4 * M_PI / 3 * 30 * 22 * 18;
  EXPECT_NEAR(EnclosedVolume(fit.surface.surface), volume, 1e-3 * volume);
  for (const double v : {1e-6, 1 - 1e-6}) {
    const Eigen::Vector3d normal = fit.surface.surface.EvaluateWithDerivatives(0, v).Normal();
    for (int k = 1; k < 9; ++k) {
      EXPECT_LT((fit.surface.surface.EvaluateWithDerivatives(k / 9.0, v).Normal() - normal).norm(), 1e-3);
    }
  }
}

TEST(ClosedFit, Apple_KeepsItsDimples) {
  const ClosedCloud cloud = AppleCloud(35, 4000, kNoise);
  const SurfaceFit fit = FitLeaf(cloud.points, OptionsFor(SurfaceTopology::kSphere, {12, 16}));
  ExpectGoodFit(cloud, fit);
}

TEST(ClosedFit, BentTube_EndsAtItsRims) {
  const ClosedCloud cloud = TubeCloud(8, 70, 1.6, 4000, kNoise);
  const SurfaceFit fit = FitLeaf(cloud.points, OptionsFor(SurfaceTopology::kTube, {10, 12}));
  ExpectGoodFit(cloud, fit, fit.quality.point_spacing);
  const bool turned = (fit.surface.surface.Evaluate(0, 0) - cloud.rims[0][0]).norm() > 30;
  ExpectRimNear(cloud.rims[turned ? 1 : 0], fit.surface.surface, false, 1.5 * fit.quality.point_spacing);
  ExpectRimNear(cloud.rims[turned ? 0 : 1], fit.surface.surface, true, 1.5 * fit.quality.point_spacing);
}

TEST(ClosedFit, Cup_EndsAtItsRimGivenOrFound) {
  const ClosedCloud cloud = EllipsoidCloud({32, 22, 20}, 4000, kNoise, 0.55);
  SurfaceFitOptions options = OptionsFor(SurfaceTopology::kCup, {12, 9});
  for (const bool given : {false, true}) {
    if (given) options.rims = cloud.rims;
    const SurfaceFit fit = FitLeaf(cloud.points, options);
    ExpectGoodFit(cloud, fit, given ? 4 * kNoise : fit.quality.point_spacing);
    ExpectRimNear(cloud.rims[0], fit.surface.surface, true, (given ? 0.5 : 1.5) * fit.quality.point_spacing);
    EXPECT_TRUE(SurfaceCells(fit.surface.surface).poles().begin);
  }
}

TEST(ClosedFit, ThreadCount_ChangesNotAByte) {
  const ClosedCloud cloud = EllipsoidCloud({32, 22, 20}, 2000, kNoise, 0.55);
  const SurfaceFitOptions options = OptionsFor(SurfaceTopology::kCup, {8, 7});
  const SurfaceFit one = FitLeaf(cloud.points, options, 1), two = FitLeaf(cloud.points, options, 2);
  EXPECT_EQ(one.surface.surface.control_points(), two.surface.surface.control_points());
  EXPECT_EQ(one.distances.signed_distance, two.distances.signed_distance);
  EXPECT_EQ(one.distances.feet, two.distances.feet);
  EXPECT_EQ(one.outlier, two.outlier);
  EXPECT_EQ(one.quality.area, two.quality.area);
  EXPECT_EQ(one.report.objective, two.report.objective);
}

TEST(ClosedFit, FarOutliers_AreLostAndTheyAlone) {
  for (const auto topology : {SurfaceTopology::kSphere, SurfaceTopology::kTube}) {
    const bool sphere = topology == SurfaceTopology::kSphere;
    const ClosedCloud cloud =
        sphere ? EllipsoidCloud({30, 22, 18}, 4000, kNoise) : TubeCloud(8, 70, 1.2, 4000, kNoise);
    Random random(5);
    Points points = cloud.points;
    std::vector<std::uint8_t> far(points.size(), 0);
    for (std::size_t i = 7; i < points.size(); i += 100) {
      points[i] += (i % 200 < 100 ? 1 : -1) * random.Uniform(3, 6) * cloud.normals[i];
      far[i] = 1;
    }
    const SurfaceFit fit = FitLeaf(points, OptionsFor(topology, {12, 10}));
    EXPECT_EQ(fit.outlier, far);
    EXPECT_LT(fit.quality.inlier_rmse, 1.1 * kNoise);
    EXPECT_LT(ErrorsAgainst(cloud.clean, fit.surface.surface).rmse, 0.5 * kNoise);
    EXPECT_EQ(fit.quality.flipped_normals, 0);
  }
}

TEST(ClosedFit, FreeWeightsWithPoles_AreAnError) {
  const ClosedCloud cloud = EllipsoidCloud({3, 2, 2}, 500, 0);
  SurfaceFitOptions options = OptionsFor(SurfaceTopology::kSphere, {6, 6});
  options.unknowns = SurfaceUnknowns::kBoth;
  EXPECT_THROW(FitLeaf(cloud.points, options), ConfigError);
  options.unknowns = SurfaceUnknowns::kControlPoints;
  options.method = SurfaceMethod::kMa;
  EXPECT_THROW(FitLeaf(cloud.points, options), ConfigError);
}

}  // namespace
}  // namespace frond
