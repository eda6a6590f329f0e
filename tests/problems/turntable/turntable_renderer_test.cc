// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turntable_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "problems/turntable/synthetic_turntable.h"
#include "problems/turntable/turntable_light.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A small and fast session: a third of the usual resolution.
SyntheticTurntableOptions SmallOptions() {
  SyntheticTurntableOptions options;
  options.focal = 600;
  options.width = 200;
  options.height = 180;
  options.free_boards = 2;
  return options;
}

TEST(TurntableRenderer, ARoundPearWithoutSpeckle_LooksTheSameFromAllSides) {
  // Because the lamp does not turn with it.
  SyntheticTurntableOptions options = SmallOptions();
  options.pear = {.bend = 0, .flattening = 0, .lobes = 0};
  options.offset = 0;
  options.contrast = 0;
  options.sensor.noise = 0;
  const SyntheticTurntable session(options);
  const SyntheticView first = session.View(0), turned = session.View(17);
  double brightest = 0;
  for (int y = 4; y < first.image.height - 4; ++y) {
    for (int x = 4; x < first.image.width - 4; ++x) {
      ASSERT_EQ(first.mask(x, y), turned.mask(x, y));
      // Well inside: at the rim the disk's speckle, which turns, shines through.
      constexpr int kRim = 4;
      if (first.mask(x - kRim, y) + first.mask(x + kRim, y) + first.mask(x, y - kRim) +
              first.mask(x, y + kRim) <
          4) {
        continue;
      }
      EXPECT_NEAR(first.image(x, y), turned.image(x, y), 1);  // rounding
      brightest = std::max<double>(brightest, first.image(x, y));
    }
  }
  EXPECT_GT(brightest, 80);
}

TEST(TurntableRenderer, APointUnderAmbientLight_KeepsItsLightAsItTurns) {
  SyntheticTurntableOptions options = SmallOptions();
  options.lighting.diffuse = options.lighting.specular = 0;
  options.lighting.ambient = 1;
  const TurntableScene scene = SyntheticTurntable(options).scene();
  const TurntableLight first(scene, 10 * kDegree, true, true), second(scene, 14 * kDegree, true, true);
  int seen = 0;
  for (const Eigen::Vector3d& vertex : scene.pear.Mesh(20, 40).vertices) {
    const Eigen::Vector3d p = scene.pear_origin + vertex;
    const Eigen::Vector3d q1 = scene.rig.CameraFromDisk(10 * kDegree) * p;
    const Eigen::Vector3d q2 = scene.rig.CameraFromDisk(14 * kDegree) * p;
    const Eigen::Vector3d normal =
        scene.rig.CameraFromDisk(10 * kDegree).linear() * scene.pear.Normal(vertex);
    if (normal.dot(q1.normalized()) > -0.4) continue;
    ++seen;
    const Eigen::Vector2d u1 = scene.rig.camera.Project(q1), u2 = scene.rig.camera.Project(q2);
    const auto light1 = first.Seen(u1.x(), u1.y()), light2 = second.Seen(u2.x(), u2.y());
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(light1[c], light2[c], 1e-3);
  }
  EXPECT_GT(seen, 100);
}

TEST(TurntableRenderer, View_HasTheNoiseAndExposureAskedFor) {
  SyntheticTurntableOptions options = SmallOptions();
  options.sensor.noise = 2;
  options.second_exposure = {.gain = 0.5, .offset = 40};
  const SyntheticTurntable session(options);
  const SyntheticView left = session.View(0), right = session.View(1);
  // A corner shows the dark room alone: 9 grey levels.
  const auto moments = [](const Image& image) {
    double sum = 0, squares = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        sum += image(x, y);
        squares += image(x, y) * image(x, y);
      }
    }
    const double mean = sum / 2400;
    return std::pair(mean, std::sqrt(squares / 2400 - mean * mean));
  };
  const double rounded = std::sqrt(4 + 1.0 / 12);
  EXPECT_NEAR(moments(left.image).first, 9, 0.2);
  EXPECT_NEAR(moments(left.image).second, rounded, 0.12);
  EXPECT_NEAR(moments(right.image).first, 44.5, 0.2);
  EXPECT_NEAR(moments(right.image).second, rounded, 0.12);
}

TEST(TurntableRenderer, View_IsTheSameForAnyNumberOfThreads) {
  const SyntheticTurntable session(SmallOptions());
  EXPECT_EQ(session.View(3, 1).image.values, session.View(3, 3).image.values);
}

TEST(TurntableRenderer, ColourView_ShowsTheSameScene) {
  SyntheticTurntableOptions options = SmallOptions();
  options.sensor.noise = 0;
  const SyntheticView grey = SyntheticTurntable(options).View(0);
  options.sensor.colour = true;
  const SyntheticView colour = SyntheticTurntable(options).View(0);
  ASSERT_FALSE(colour.colour.empty());
  EXPECT_TRUE(grey.colour.empty());
  for (std::size_t i = 0; i < grey.image.values.size(); ++i) {
    ASSERT_NEAR(grey.image.values[i], colour.image.values[i], 1.01);
  }
}

TEST(TurntableRenderer, Mask_IsTheSilhouette) {
  const SyntheticTurntable session(SmallOptions());
  const SyntheticView view = session.View(5);
  const Eigen::Isometry3d disk_from_camera = session.rig().CameraFromDisk(view.angle).inverse();
  for (int y = 0; y < view.mask.height; y += 3) {
    for (int x = 0; x < view.mask.width; x += 3) {
      const Eigen::Vector3d ray = disk_from_camera.linear() * session.rig().camera.Ray(Eigen::Vector2d(x, y));
      const bool hit = CastRay(session.scene(), disk_from_camera.translation(), ray).has_value();
      EXPECT_EQ(view.mask(x, y) == 1, hit) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace frond
