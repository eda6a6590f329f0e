// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/synthetic_turntable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/mesh_topology.h"
#include "problems/turntable/board_detection.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SyntheticTurntableOptions SquareOn() {
  SyntheticTurntableOptions options;
  options.tilt = options.offset = 0;
  options.distortion = {0, 0, 0, 0, 0};
  return options;
}

Rectification NormalOf(const SyntheticTurntable& session, double phi) {
  const TurntableRig& rig = session.rig();
  const double height = session.scene().pear_origin.z() + session.options().pear.height / 2;
  return Rectify(rig.Pair(phi / 2, -phi / 2), rig.CameraFromDisk(phi / 2) * Eigen::Vector3d(0, 0, height));
}

TEST(SyntheticTurntable, Rig_IsTheOneAskedFor) {
  SyntheticTurntableOptions options;
  options.tilt = 12;
  options.roll = -3;
  options.distance = 550;
  const SyntheticTurntable session(options);
  EXPECT_NEAR(session.rig().AxisDistance(), 550, 1e-9);
  EXPECT_NEAR(session.rig().Tilt(), 12 * kDegree, 1e-12);
  EXPECT_NEAR(session.rig().Roll(), -3 * kDegree, 1e-12);
  // It looks at the axis at the middle of the pear's height.
  const Eigen::Vector3d aim =
      session.rig().camera_from_disk * Eigen::Vector3d(0, 0, session.scene().pear_origin.z() + 50);
  EXPECT_LT(aim.head<2>().norm(), 1e-9);
}

TEST(SyntheticTurntable, NormalImages_ShowAPointInTheSameRow) {
  SyntheticTurntableOptions options;
  options.roll = 2;
  const SyntheticTurntable session(options);
  const double phi = 5 * kDegree;
  const Rectification normal = NormalOf(session, phi);
  for (const Eigen::Vector3d& p : session.TruthMesh(12, 12).vertices) {
    const Eigen::Vector3d left = normal.rotation[0] * (session.rig().CameraFromDisk(phi / 2) * p);
    const Eigen::Vector3d right = normal.rotation[1] * (session.rig().CameraFromDisk(-phi / 2) * p);
    EXPECT_NEAR(normal.f * left.y() / left.z(), normal.f * right.y() / right.z(), 1e-9);
    const double disparity =
        normal.f * left.x() / left.z() + normal.cx[0] - (normal.f * right.x() / right.z() + normal.cx[1]);
    EXPECT_NEAR(normal.Project(session.rig().CameraFromDisk(phi / 2) * p).z(), disparity, 1e-9);
  }
}

TEST(SyntheticTurntable, SquareOnCamera_MakesEquations4To7OfTheGeneralRotations) {
  const SyntheticTurntable session(SquareOn());
  for (const double phi : {2 * kDegree, 4 * kDegree, 15 * kDegree}) {
    const Rectification normal = NormalOf(session, phi);
    const double f = session.options().focal;
    for (const double x : {-400.0, -30.0, 0.0, 250.0}) {
      for (const double y : {-300.0, 10.0, 180.0}) {
        const Eigen::Vector3d ray(x, y, f);
        const Eigen::Vector3d left = normal.rotation[0] * ray, right = normal.rotation[1] * ray;
        const Eigen::Vector2d eq67 = SquareOnNormalLeft(f, phi, {x, y});
        const Eigen::Vector2d eq45 = SquareOnNormalRight(f, phi, {x, y});
        const double tolerance = 2e-13 * f;  // relative to the focal length
        EXPECT_NEAR(f * left.x() / left.z(), eq67.x(), tolerance);
        EXPECT_NEAR(f * left.y() / left.z(), eq67.y(), tolerance);
        EXPECT_NEAR(f * right.x() / right.z(), eq45.x(), tolerance);
        EXPECT_NEAR(f * right.y() / right.z(), eq45.y(), tolerance);
      }
    }
  }
}

TEST(SyntheticTurntable, TrueMatch_TriangulatesToThePear) {
  const SyntheticTurntable session{SyntheticTurntableOptions()};
  const double phi = 4 * kDegree;
  const Rectification normal = NormalOf(session, phi);
  const Eigen::Isometry3d disk_from_left = session.rig().CameraFromDisk(phi / 2).inverse();
  int matches = 0, hidden = 0;
  for (int y = 0; y < normal.height; y += 7) {
    for (int x = 0; x < normal.width; x += 7) {
      const auto match = FindTrueMatch(session.scene(), normal, phi / 2, -phi / 2, x, y);
      if (!match) continue;
      ++matches;
      hidden += match->seen ? 0 : 1;
      const Eigen::Vector3d p = disk_from_left * normal.Triangulate(x, y, match->disparity);
      EXPECT_LT((p - match->point).norm(), 1e-9);
      EXPECT_LT(std::abs(DistanceToPear(session.scene(), p)), 1e-9);
      EXPECT_GT(match->left_cosine, 0);
      // A point turned away from the right camera is not seen by it.
      EXPECT_TRUE(match->right_cosine > 0 || !match->seen);
    }
  }
  EXPECT_GT(matches, 900);
  EXPECT_GT(hidden, 0);
  EXPECT_LT(hidden, matches / 20);
}

TEST(SyntheticTurntable, Views_GoRoundInPairsWithTheLeftOneAhead) {
  SyntheticTurntableOptions options;
  options.pairs = 6;
  options.phi = 3;
  options.angle_error = 0.1;
  const SyntheticTurntable session(options);
  ASSERT_EQ(session.views().size(), 12u);
  for (std::size_t i = 0; i < 12; i += 2) {
    const PlannedView& left = session.views()[i];
    const PlannedView& right = session.views()[i + 1];
    EXPECT_TRUE(left.left && !right.left && left.pair == right.pair);
    EXPECT_NEAR(left.angle - right.angle, 3, 1e-12);
    EXPECT_NEAR((left.angle + right.angle) / 2, 60.0 * static_cast<double>(i / 2), 1e-12);
    EXPECT_NE(left.angle, left.true_angle);
    EXPECT_NEAR(left.angle, left.true_angle, 0.6);
  }
}

TEST(SyntheticTurntable, BoardViews_ShowTheCornersWhereTheyAre) {
  const SyntheticTurntable session{SyntheticTurntableOptions()};
  ASSERT_EQ(session.boards().size(), 25u);
  for (const std::size_t index : {std::size_t{0}, std::size_t{6}, std::size_t{11}, std::size_t{14}}) {
    const SyntheticBoardView view = session.BoardView(index);
    EXPECT_EQ(view.angle.has_value(), index < 13);
    const auto found = DetectBoard(view.image, session.options().board);
    ASSERT_TRUE(found.has_value()) << index;
    ASSERT_EQ(found->pixels.size(), view.corners.size());
    double squares = 0;
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
      squares += (found->pixels[i] - view.corners[i]).squaredNorm();
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(view.corners.size())), 0.06) << index;
  }
}

TEST(SyntheticTurntable, BoardsOnTheDisk_TurnAboutItsAxis) {
  const SyntheticTurntable session{SyntheticTurntableOptions()};
  const PlannedBoard& first = session.boards()[0];
  for (const PlannedBoard& board : session.boards()) {
    if (!board.angle) continue;
    const Eigen::Isometry3d in_disk =
        session.rig().CameraFromDisk(*board.angle * kDegree).inverse() * board.camera_from_board;
    const Eigen::Isometry3d same =
        session.rig().CameraFromDisk(*first.angle * kDegree).inverse() * first.camera_from_board;
    EXPECT_TRUE(in_disk.isApprox(same, 1e-12));
  }
}

TEST(SyntheticTurntable, Options_ReadBackTheDefaults) {
  const SyntheticTurntableOptions read = SyntheticTurntableOptionsFrom(Options(SyntheticTurntableSpecs()), 1);
  const SyntheticTurntable a(read), b{SyntheticTurntableOptions()};
  EXPECT_EQ(a.TruthValues(), b.TruthValues());
  EXPECT_EQ(a.View(2).image.values, b.View(2).image.values);
}

TEST(SyntheticTurntable, BoardTooLargeForTheImage_IsRefused) {
  SyntheticTurntableOptions options;
  options.board.square = 40;
  EXPECT_THROW(SyntheticTurntable{options}, ConfigError);
}

TEST(SyntheticTurntable, TruthMesh_StandsOnTheDisk) {
  const SyntheticTurntable session{SyntheticTurntableOptions()};
  const SurfaceMesh mesh = session.TruthMesh();
  EXPECT_TRUE(FindMeshTopology(mesh).closed);
  double lowest = 1e9;
  for (const Eigen::Vector3d& vertex : mesh.vertices) lowest = std::min(lowest, vertex.z());
  EXPECT_NEAR(lowest, session.scene().pear_origin.z(), 1e-9);
}

}  // namespace
}  // namespace frond
