// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turned_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "tests/problems/turntable/pear_scan.h"

namespace frond {
namespace {

constexpr double kHeight = 100;

std::unique_ptr<Solver> LevenbergMarquardt(const SurfaceFitOptions& options) {
  const SolverType& type = FindSolverType("lm");
  Options solver_options(type.options);
  for (const auto& [name, value] : SurfaceFitSolverDefaults("lm", options)) solver_options.Set(name, value);
  return type.create(solver_options);
}

struct PearErrors {
  double rmse = 0, max = 0;
};

// Of the surface's points, evenly by area, against the true pear.
PearErrors ErrorsOf(const NurbsSurface& surface, const LobedPear& pear) {
  PearErrors errors;
  double area = 0;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) {
      const double u = (k + 0.5) / 60, v = (i + 0.5) / 60;
      const Eigen::Vector3d du = surface.Evaluate(u + 1e-5, v) - surface.Evaluate(u - 1e-5, v),
                            dv = surface.Evaluate(u, v + 1e-5) - surface.Evaluate(u, v - 1e-5);
      const double weight = du.cross(dv).norm(), d = pear.SignedDistance(surface.Evaluate(u, v));
      area += weight;
      errors.rmse += weight * d * d;
      errors.max = std::max(errors.max, std::abs(d));
    }
  }
  errors.rmse = std::sqrt(errors.rmse / area);
  return errors;
}

TurnedSurfaceFit FitPear(double cut_degrees, double noise, std::array<int, 2> net, std::uint64_t seed) {
  Random random(seed);
  const double cut = cut_degrees * std::numbers::pi / 180;
  const std::vector<Eigen::Vector3d> points =
      PearPoints({}, 8000, cut, std::numbers::pi - cut, noise, &random);
  SurfaceFitOptions options;
  options.control_points = net;
  options.topology = SurfaceTopology::kSphere;
  return FitTurnedSurface(points, {}, options, *LevenbergMarquardt(options), {}, {.threads = 2, .seed = 1});
}

TEST(TurnedSurface, UnseenPoles_AreClosedWithinThreeThousandthsOfTheHeight) {
  for (const double cut : {10.0, 15.0, 20.0, 25.0}) {
    const TurnedSurfaceFit turned = FitPear(cut, 1e-3 * kHeight, {14, 14}, 3);
    const PearErrors errors = ErrorsOf(turned.surface.surface, {});
    printf("cut %g: rmse %g max %g flipped %d outliers %ld\n", cut, errors.rmse, errors.max,
           turned.fit.quality.flipped_normals,
           std::count(turned.fit.outlier.begin(), turned.fit.outlier.end(), 1));
    EXPECT_LE(errors.rmse, 3e-3 * kHeight);
    EXPECT_EQ(turned.fit.quality.flipped_normals, 0);
  }
}

}  // namespace
}  // namespace frond
