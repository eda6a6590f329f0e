// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/axis_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/errors.h"
#include "tests/problems/turntable/board_views.h"

namespace frond {
namespace {

const Board kBoard{.columns = 9, .rows = 6, .square = 12};

double DirectionError(const TurntableRig& rig, const TurntableRig& truth) {
  const Eigen::Vector3d a = rig.camera_from_disk.linear().col(2), b = truth.camera_from_disk.linear().col(2);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool Mentions(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

std::string ErrorOf(const std::vector<AxisView>& views) {
  try {
    CalibrateAxis(ExampleCamera(), views, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AxisCalibrationTest, Axis_WithoutNoise_IsExact) {
  Random random(1);
  for (const double tilt : {0.0, 10.0, -20.0, 45.0}) {
    const TurntableRig truth = ExampleRig(tilt * kDegree);
    const auto views = ExampleViews(truth, kBoard, DegreesFrom(-60, 60, 13), 0, &random);
    const AxisCalibration found = CalibrateAxis(truth.camera, views, {});
    EXPECT_LT(DirectionError(found.rig, truth), 1e-9) << tilt;
    EXPECT_TRUE(found.rig.camera_from_disk.isApprox(truth.camera_from_disk, 1e-9)) << tilt;
    EXPECT_TRUE(found.disk_from_board.isApprox(ExampleBoardOnDisk(kBoard), 1e-9)) << tilt;
    EXPECT_NEAR(found.distance.value, truth.AxisDistance(), 1e-6);
    EXPECT_NEAR(found.tilt.value, truth.Tilt(), 1e-9);
    EXPECT_NEAR(found.roll.value, truth.Roll(), 1e-9);
    EXPECT_TRUE(found.warnings.empty()) << found.warnings.front();
    EXPECT_EQ(found.notes.empty(), tilt == 0);
  }
}

// The square of the reported deviation over that of the scatter: its mean is 1 where the deviation is true.
// Over n draws the scatter of one value has a relative standard deviation of √(1/2n).
struct Scatter {
  double worst_direction = 0;
  Eigen::VectorXd scatter, sigma;  // of axis.direction_x, _z (radians), d, tilt, roll
};

Scatter MeasureScatter(int seeds, const AxisOptions& options) {
  const TurntableRig truth = ExampleRig(10 * kDegree);
  const Eigen::Vector3d up = truth.camera_from_disk.linear().col(2);
  const Eigen::Vector3d along = (Eigen::Vector3d::UnitZ() - up.z() * up).normalized();
  const Eigen::Vector3d across = along.cross(up);
  Scatter result{.scatter = Eigen::VectorXd::Zero(5), .sigma = Eigen::VectorXd::Zero(5)};
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 1);
    const auto views = ExampleViews(truth, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
    const AxisCalibration found = CalibrateAxis(truth.camera, views, options);
    result.worst_direction = std::max(result.worst_direction, DirectionError(found.rig, truth));
    const Eigen::Vector3d seen = found.rig.camera_from_disk.linear().col(2);
    Eigen::VectorXd error(5), variance(5);
    error << seen.dot(across), seen.dot(along), found.distance.value - truth.AxisDistance(),
        found.tilt.value - truth.Tilt(), found.roll.value - truth.Roll();
    variance << found.covariance(0, 0), found.covariance(1, 1), std::pow(found.distance.sigma, 2),
        std::pow(found.tilt.sigma, 2), std::pow(found.roll.sigma, 2);
    result.scatter += error.cwiseAbs2() / seeds;
    result.sigma += variance / seeds;
  }
  result.scatter = result.scatter.cwiseSqrt();
  result.sigma = result.sigma.cwiseSqrt();
  return result;
}

void Print(const char* name, int seeds, const Scatter& s) {
  std::printf(
      "%s, %d seeds: direction at worst %.4f degrees; scatter / reported of direction x, z, d, tilt, "
      "roll:",
      name, seeds, s.worst_direction / kDegree);
  for (Eigen::Index k = 0; k < 5; ++k) std::printf(" %.3f", s.scatter[k] / s.sigma[k]);
  std::printf("\n  reported: %.5f %.5f degrees, %.4f\n", s.sigma[0] / kDegree, s.sigma[1] / kDegree,
              s.sigma[2]);
}

TEST(AxisCalibrationTest, Axis_Of13NoisyAngles_IsWithin008DegreesAndItsSigmaIsTheScatter) {
  // 20 draws know the scatter to 16 %: the 20 % asked for, plus 2.5 of these. Set FROND_AXIS_SEEDS to more.
  const char* const more = std::getenv("FROND_AXIS_SEEDS");
  const int seeds = more != nullptr ? std::atoi(more) : 20;
  const double sampling = std::sqrt(0.5 / seeds);
  for (const bool free_angles : {false, true}) {
    const Scatter s = MeasureScatter(seeds, {.free_angles = free_angles});
    Print(free_angles ? "angles free" : "angles held", seeds, s);
    EXPECT_LE(s.worst_direction, 0.08 * kDegree);
    for (Eigen::Index k = 0; k < 5; ++k) {
      EXPECT_NEAR(s.scatter[k] / s.sigma[k], 1, 0.2 + (more != nullptr ? 0 : 2.5 * sampling)) << k;
    }
  }
}

TEST(AxisCalibrationTest, Axis_OfNegatedAngles_IsRefusedAndTheWayOutSaid) {
  Random random(3);
  auto views = ExampleViews(ExampleRig(10 * kDegree), kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
  for (AxisView& view : views) view.angle = -view.angle;
  const std::string error = ErrorOf(views);
  EXPECT_NE(error.find("the table turns the other way"), std::string::npos) << error;
  EXPECT_NE(error.find("negate the angles"), std::string::npos);
}

TEST(AxisCalibrationTest, Axis_OfNegatedAnglesOverAFullTurn_IsRefused) {
  // A board lying on the disk, seen from above at all angles.
  const Board board{.columns = 7, .rows = 6, .square = 10};
  const TurntableRig rig = ExampleRig(40 * kDegree);
  Eigen::Isometry3d lying = Eigen::Isometry3d::Identity();
  lying.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  lying.translation() = Eigen::Vector3d(-30, 25, 0);
  Random random(3);
  std::vector<AxisView> views;
  for (int k = 0; k < 12; ++k) {
    const double angle = 30 * k * kDegree;
    views.push_back(
        {.angle = angle,
         .corners = SeenCorners(rig.camera, rig.CameraFromDisk(angle) * lying, board, 0.1, &random),
         .name = std::to_string(30 * k)});
  }
  EXPECT_LT(DirectionError(CalibrateAxis(rig.camera, views, {}).rig, rig), 0.08 * kDegree);
  for (AxisView& view : views) view.angle = -view.angle;
  EXPECT_NE(ErrorOf(views).find("the table turns the other way"), std::string::npos);
}

TEST(AxisCalibrationTest, Axis_WithOneWrongAngle_NamesTheViewAndTheAngle) {
  Random random(4);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{4}, std::size_t{12}}) {
    auto spoilt = views;
    spoilt[wrong].angle += 2 * kDegree;
    const AxisCalibration found = CalibrateAxis(rig.camera, spoilt, {});
    ASSERT_TRUE(Mentions(found.warnings, spoilt[wrong].name + ": its angle does not fit")) << wrong;
    EXPECT_TRUE(Mentions(found.warnings, "is off by 2") || Mentions(found.warnings, "is off by 1.9"))
        << found.warnings.front();
    for (std::size_t k = 0; k < views.size(); ++k) {
      EXPECT_EQ(Mentions(found.warnings, views[k].name + ": its angle"), k == wrong) << k;
    }
    // With the angles free the wrong one does no harm.
    const AxisCalibration freed = CalibrateAxis(rig.camera, spoilt, {.free_angles = true});
    EXPECT_LT(DirectionError(freed.rig, rig), 0.08 * kDegree);
    const int from = wrong == 0 ? 1 : 0;
    EXPECT_NEAR(TurnBetween(freed, from, static_cast<int>(wrong)).value,
                views[wrong].angle - views[static_cast<std::size_t>(from)].angle, 0.05 * kDegree);
  }
}

TEST(AxisCalibrationTest, Axis_OfAWrongScaleOfAngles_SaysTheFactor) {
  Random random(5);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
  for (AxisView& view : views) view.angle /= 1.02;
  const AxisCalibration found = CalibrateAxis(rig.camera, views, {});
  EXPECT_TRUE(Mentions(found.warnings, "the table turns 1.02 times"));
}

TEST(AxisCalibrationTest, Axis_OfATableThatSkips_SaysFromWhichViewOn) {
  Random random(6);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
  for (std::size_t k = 7; k < views.size(); ++k) views[k].angle -= 1.5 * kDegree;
  const AxisCalibration found = CalibrateAxis(rig.camera, views, {});
  EXPECT_TRUE(Mentions(found.warnings, "from " + views[7].name + " on the angles are off by 1.5"));
}

TEST(AxisCalibrationTest, Turns_WhereAnglesAreFree_AreKnownToTheirSigma) {
  const TurntableRig rig = ExampleRig(10 * kDegree);
  constexpr int kSeeds = 20;
  double scatter = 0, variance = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 50);
    auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
    for (AxisView& view : views) view.angle += 0.2 * kDegree * random.Normal();
    const AxisCalibration found = CalibrateAxis(rig.camera, views, {.free_angles = true});
    const Estimate turn = TurnBetween(found, 4, 5);
    scatter += std::pow(turn.value - 10 * kDegree, 2) / kSeeds;
    variance += turn.sigma * turn.sigma / kSeeds;
  }
  EXPECT_NEAR(std::sqrt(scatter / variance), 1, 0.2 + 2.5 * std::sqrt(0.5 / kSeeds));
}

TEST(AxisCalibrationTest, Axis_WithAPriorOfTheAngles_LiesBetweenHeldAndFree) {
  Random random(7);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  const auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 13), 0.1, &random);
  const AxisCalibration held = CalibrateAxis(rig.camera, views, {});
  const AxisCalibration prior =
      CalibrateAxis(rig.camera, views, {.free_angles = true, .angle_sigma = 0.01 * kDegree});
  const AxisCalibration free = CalibrateAxis(rig.camera, views, {.free_angles = true});
  const auto unit_variance = [](const AxisCalibration& c) {
    return c.covariance(1, 1) / (c.corner_sigma * c.corner_sigma);
  };
  EXPECT_LT(unit_variance(held), unit_variance(prior));
  EXPECT_LT(unit_variance(prior), unit_variance(free));
  EXPECT_NEAR(held.corner_sigma, 0.1, 0.005);
  EXPECT_NEAR(prior.corner_sigma, 0.1, 0.005);
  EXPECT_NEAR(free.corner_sigma, 0.1, 0.005);
}

TEST(AxisCalibrationTest, Axis_OfAHalfTurnSymmetricBoard_IsFoundFromAnyReadingOfItsEnds) {
  Random random(8);
  const Board board{.columns = 8, .rows = 6, .square = 12};
  const TurntableRig rig = ExampleRig(10 * kDegree);
  auto views = ExampleViews(rig, board, DegreesFrom(-60, 60, 13), 0.1, &random);
  for (const std::size_t k : {2u, 3u, 7u, 12u}) views[k].corners = TurnedUpsideDown(views[k].corners);
  const AxisCalibration found = CalibrateAxis(rig.camera, views, {});
  EXPECT_LT(DirectionError(found.rig, rig), 0.08 * kDegree);
  EXPECT_LT(found.rms, 0.2);
}

TEST(AxisCalibrationTest, Axis_WithTheCameraFree_FindsItsFocalLength) {
  Random random(9);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  const auto views = ExampleViews(rig, kBoard, DegreesFrom(-60, 60, 25), 0.05, &random);
  PinholeCamera wrong = rig.camera;
  wrong.focal[0] = wrong.focal[1] = 2020;
  const AxisCalibration found = CalibrateAxis(wrong, views, {.free_camera = true});
  const auto at = std::find(found.parameter_names.begin(), found.parameter_names.end(), "camera.fx") -
                  found.parameter_names.begin();
  ASSERT_LT(at, static_cast<std::ptrdiff_t>(found.parameter_names.size()));
  EXPECT_LT(std::abs(found.rig.camera.focal[0] - 2000), 4 * std::sqrt(found.covariance(at, at)));
  EXPECT_LT(found.rms, 0.1);
}

TEST(AxisCalibrationTest, FewAngles_AreWarnedOfAndTooFewRefused) {
  Random random(10);
  const TurntableRig rig = ExampleRig(10 * kDegree);
  const auto five = ExampleViews(rig, kBoard, DegreesFrom(-10, 10, 5), 0.1, &random);
  const AxisCalibration found = CalibrateAxis(rig.camera, five, {});
  EXPECT_TRUE(Mentions(found.warnings, "from 5 table angle(s) only"));
  EXPECT_TRUE(Mentions(found.warnings, "span 20 degrees only"));
  const auto two = ExampleViews(rig, kBoard, {0, 20, 20, 360}, 0.1, &random);
  EXPECT_NE(ErrorOf(two).find("at 2 table angle(s), the axis needs at least 3"), std::string::npos);
}

}  // namespace
}  // namespace frond
