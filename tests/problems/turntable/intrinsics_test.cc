// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/intrinsics.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/problems/turntable/board_views.h"

namespace frond {
namespace {

const Board kBoard{.columns = 9, .rows = 6, .square = 20};

std::vector<BoardCorners> TiltedViews(int count, double tilt, double noise, Random* random) {
  std::vector<BoardCorners> views;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d about(std::cos(2.4 * k), std::sin(2.4 * k), 0.2);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(tilt, about.normalized()).toRotationMatrix();
    const Eigen::Vector3d centre(80, 50, 0);
    pose.translation() = Eigen::Vector3d(60 * std::cos(1.7 * k), 40 * std::sin(1.7 * k), 520 + 10 * k) -
                         pose.linear() * centre;
    views.push_back(SeenCorners(ExampleCamera(), pose, kBoard, noise, random));
  }
  return views;
}

std::vector<std::string> Names(int count) {
  std::vector<std::string> names;
  for (int k = 0; k < count; ++k) names.push_back("view" + std::to_string(k) + ".png");
  return names;
}

TEST(IntrinsicsTest, Camera_FromViewsWithoutNoise_IsExact) {
  Random random(1);
  const auto found = CalibrateIntrinsics(TiltedViews(10, 0.5, 0, &random), Names(10), 1280, 1024, {});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found.camera.focal[k], ExampleCamera().focal[k], 0.02) << k;
  EXPECT_LT(found.rms, 1e-3);  // OpenCV takes corners in single precision
  EXPECT_EQ(found.camera.width, 1280);
  EXPECT_TRUE(found.warnings.empty());
}

TEST(IntrinsicsTest, Sigma_IsTheScatterOverSeeds) {
  constexpr int kSeeds = 20;
  std::array<double, 4> scatter{}, variance{};
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 1);
    const auto found = CalibrateIntrinsics(TiltedViews(10, 0.5, 0.1, &random), Names(10), 1280, 1024, {});
    for (std::size_t k = 0; k < 4; ++k) {
      scatter[k] += std::pow(found.camera.focal[k] - ExampleCamera().focal[k], 2) / kSeeds;
      variance[k] += std::pow(found.focal_sigma[k], 2) / kSeeds;
    }
  }
  // 20 draws know the scatter to 16 %; OpenCV 4.6's own deviations would be 1.4 times too large.
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(std::sqrt(scatter[k] / variance[k]), 1, 2.5 * std::sqrt(0.5 / kSeeds)) << k;
  }
}

TEST(IntrinsicsTest, Held_ParametersStayAndHaveNoSigma) {
  Random random(2);
  const auto found =
      CalibrateIntrinsics(TiltedViews(10, 0.5, 0.1, &random), Names(10), 1280, 1024,
                          {.square_pixels = true, .tangential_distortion = false, .radial_distortion = 2});
  EXPECT_DOUBLE_EQ(found.camera.focal[0], found.camera.focal[1]);
  EXPECT_EQ(found.camera.distortion[2], 0);
  EXPECT_EQ(found.camera.distortion[4], 0);
  EXPECT_EQ(found.distortion_sigma[2], 0);
  EXPECT_EQ(found.distortion_sigma[4], 0);
  EXPECT_GT(found.distortion_sigma[0], 0);
}

TEST(IntrinsicsTest, Views_TooFewOrParallel_AreRefused) {
  Random random(3);
  EXPECT_THROW(CalibrateIntrinsics(TiltedViews(2, 0.5, 0, &random), Names(2), 1280, 1024, {}), InputError);
  EXPECT_THROW(CalibrateIntrinsics(TiltedViews(10, 0, 0.1, &random), Names(10), 1280, 1024, {}), InputError);
}

TEST(IntrinsicsTest, View_OfAnotherBoardOrder_IsNamed) {
  Random random(4);
  auto views = TiltedViews(12, 0.5, 0.1, &random);
  for (std::size_t k = 0; k < views[5].pixels.size(); k += 3) views[5].pixels[k].x() += 4;
  const auto found = CalibrateIntrinsics(views, Names(12), 1280, 1024, {});
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_EQ(found.warnings[0].rfind("view5.png: its corners are off by ", 0), 0u) << found.warnings[0];
}

}  // namespace
}  // namespace frond
