// SPDX-License-Identifier: BSD-3-Clause
#include "models/enclosed_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/errors.h"
#include "models/mesh_topology.h"
#include "models/nurbs_operations.h"
#include "models/tessellation.h"
#include "tests/models/closed_surfaces.h"
#include "tests/models/example_surfaces.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

NurbsSurface TurnedTorus(double large, double small, int around = 48) {
  std::vector<Eigen::Vector2d> profile;
  const double scale = 3 / (2 + std::cos(2 * kPi / around));
  for (int j = 0; j < around + 3; ++j) {
    const double angle = 2 * kPi * (j % around) / around;
    profile.emplace_back(large + scale * small * std::cos(angle), scale * small * std::sin(angle));
  }
  return Turned(PeriodicUniformBasis(3, around), profile, std::vector<double>(profile.size(), 1));
}

// u the other way round.
NurbsSurface TurnedOver(const NurbsSurface& surface) {
  std::vector<Eigen::Vector3d> points = surface.control_points();
  for (auto& point : points) point.y() = -point.y();
  return {surface.u(), surface.v(), points, surface.weights()};
}

NurbsSurface Shifted(const NurbsSurface& surface, const Eigen::Vector3d& by) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation() = by;
  return Transformed(surface, motion);
}

TEST(EnclosedVolume, OfTurnedShapes_IsTheirs) {
  const auto expect = [](const NurbsSurface& surface, double volume) {
    EXPECT_NEAR(EnclosedVolume(surface), volume, 2e-6 * volume);
    EXPECT_NEAR(EnclosedVolume(TurnedOver(surface)), -volume, 2e-6 * volume);
    EXPECT_NEAR(EnclosedVolume(Shifted(surface, {400, -300, 200})), volume, 2e-6 * volume);
  };
  expect(TurnedSphere(2.5), 4.0 / 3 * kPi * 2.5 * 2.5 * 2.5);
  expect(TurnedTube(1.5, 7), kPi * 1.5 * 1.5 * 7);
  expect(TurnedCup(2), 2.0 / 3 * kPi * 8);
  expect(TurnedTorus(5, 2), 2 * kPi * kPi * 5 * 4);
}

TEST(EnclosedVolume, OfAnEgg_IsThatOfItsMesh) {
  const NurbsSurface egg = Egg({.begin = true, .end = true});
  const double volume = EnclosedVolume(egg);
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(MeshVolume(Tessellate({egg, {}}, 40)), volume, 1e-3 * volume);
}

TEST(EnclosedVolume, OfASurfaceOpenAlongU_IsAnError) {
  EXPECT_THROW(EnclosedVolume(PlaneSurface(3, 5)), InputError);
}

TEST(VolumeBetween, CoaxialCylinders_IsThatOfTheRing) {
  const NurbsSurface outer = TurnedTube(3, 10), inner = TurnedTube(2, 10);
  const double volume = kPi * (9 - 4) * 10;
  for (const NurbsSurface& other : {inner, TurnedOver(inner)}) {
    EXPECT_NEAR(VolumeBetween(outer, other), volume, 1e-5 * volume);
    EXPECT_NEAR(VolumeBetween(TurnedOver(outer), other), volume, 1e-5 * volume);
  }
  // The rims need not lie in a plane: the inner one stands out by 1 at both ends, joined by cones.
  const NurbsSurface longer = Shifted(TurnedTube(2, 12), {0, 0, -1});
  const double cones = 2 * kPi / 3 * (9 + 6 + 4) - 2 * kPi * 4;  // beyond the outer ends
  EXPECT_NEAR(VolumeBetween(outer, longer), volume + cones, 1e-5 * volume);
}

TEST(VolumeBetween, HemisphericalCups_IsThatOfTheShell) {
  const NurbsSurface outer = TurnedCup(3), inner = TurnedCup(2);
  const double volume = 2.0 / 3 * kPi * (27 - 8);
  for (const NurbsSurface& other : {inner, TurnedOver(inner)}) {
    EXPECT_NEAR(VolumeBetween(outer, other), volume, 1e-5 * volume);
    EXPECT_NEAR(VolumeBetween(Shifted(TurnedOver(outer), {0, 0, 0}), other), volume, 1e-5 * volume);
  }
  EXPECT_NEAR(VolumeBetween(Shifted(outer, {50, 60, 70}), Shifted(inner, {50, 60, 70})), volume,
              1e-5 * volume);
}

TEST(VolumeBetween, Spheres_IsTheDifference) {
  const double volume = 4.0 / 3 * kPi * (27 - 8);
  EXPECT_NEAR(VolumeBetween(TurnedSphere(3), TurnedSphere(2)), volume, 1e-5 * volume);
}

TEST(VolumeBetween, WallsWithUnlikeRims_AreAnError) {
  EXPECT_THROW(VolumeBetween(TurnedTube(3, 4), TurnedCup(2)), InputError);
  EXPECT_THROW(VolumeBetween(TurnedCup(2), TurnedTube(3, 4)), InputError);
  EXPECT_THROW(VolumeBetween(TurnedSphere(2), TurnedCup(1)), InputError);
}

}  // namespace
}  // namespace frond
