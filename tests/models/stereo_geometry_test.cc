// SPDX-License-Identifier: BSD-3-Clause
// Cameras, rigs and normal images against OpenCV, the paper's equations and exact projections.
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/calib3d.hpp>

#include "base/errors.h"
#include "models/pinhole_camera.h"
#include "models/rectification.h"
#include "models/turntable_rig.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

PinholeCamera DistortedCamera() {
  PinholeCamera camera;
  camera.width = 800;
  camera.height = 600;
  camera.focal = {900, 905, 402.5, 297.25};
  camera.distortion = {-0.26, 0.11, 1.7e-3, -2.8e-4, -0.04};
  return camera;
}

PinholeCamera PaperCamera() {
  PinholeCamera camera;
  camera.width = 801;
  camera.height = 601;
  camera.focal = {2000, 2000, 400, 300};
  return camera;
}

// The square-on rig: the axis upright at distance d in front of the camera.
TurntableRig SquareOnRig(double d) { return RigFromAxis(PaperCamera(), {0, 0, d}, {0, -1, 0}); }

const Eigen::Vector3d kScene[] = {{0, 0, 0}, {30, -10, 45}, {-20, 25, -40}, {35, 5, 10}, {-5, -38, 20}};

TEST(PinholeCamera, Project_MatchesOpenCv) {
  const PinholeCamera camera = DistortedCamera();
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << camera.focal[0], 0, camera.focal[2], 0, camera.focal[1],
                          camera.focal[3], 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  for (const Eigen::Vector3d& p : kScene) {
    const Eigen::Vector3d point = p + Eigen::Vector3d(0, 0, 150);
    std::vector<cv::Point2d> pixel;
    cv::projectPoints(std::vector<cv::Point3d>{{point.x(), point.y(), point.z()}}, cv::Vec3d(0, 0, 0),
                      cv::Vec3d(0, 0, 0), matrix, distortion, pixel);
    EXPECT_NEAR(camera.Project(point).x(), pixel[0].x, 1e-9);
    EXPECT_NEAR(camera.Project(point).y(), pixel[0].y, 1e-9);
  }
}

TEST(PinholeCamera, Ray_UndoesProject) {
  const PinholeCamera camera = DistortedCamera();
  for (const double u : {0., 200., 799.}) {
    for (const double v : {0., 300., 599.}) {
      EXPECT_LT((camera.Project(camera.Ray({u, v})) - Eigen::Vector2d(u, v)).norm(), 1e-9);
    }
  }
}

TEST(PinholeCamera, Ray_OfDistortionThatFoldsOver_IsRefused) {
  PinholeCamera camera = DistortedCamera();
  camera.distortion = {-3, 0, 0, 0, 0};
  EXPECT_THROW((void)camera.Ray({0, 0}), InputError);
}

TEST(TurntableRig, FromAxis_HasOriginNextToTheCameraAndAxisUp) {
  const Eigen::Vector3d point(3, 90, 620), direction(0.01, 0.98, -0.17);
  const TurntableRig rig = RigFromAxis(PaperCamera(), point, direction);
  const Eigen::Vector3d up = rig.camera_from_disk.linear().col(2);
  EXPECT_LT(up.cross(direction.normalized()).norm(), 1e-14);
  EXPECT_LT(up.y(), 0);
  EXPECT_NEAR(rig.camera_from_disk.translation().dot(up), 0, 1e-12);
  EXPECT_LT((rig.camera_from_disk.translation() - point).cross(up).norm(), 1e-11);
  EXPECT_NEAR(rig.camera_from_disk.linear().determinant(), 1, 1e-14);
  // The camera's centre lies on +x of the disk's frame.
  const Eigen::Vector3d centre = rig.camera_from_disk.inverse().translation();
  EXPECT_NEAR(centre.x(), rig.AxisDistance(), 1e-11);
  EXPECT_NEAR(centre.tail<2>().norm(), 0, 1e-11);
}

TEST(TurntableRig, CameraThatLooksDown_HasPositiveTilt) {
  // Looking down by 10 degrees, the axis upright in the room leans towards the camera at its top.
  const double tilt = 10 * kDegree;
  const TurntableRig rig = RigFromAxis(PaperCamera(), {0, 0, 600}, {0, -std::cos(tilt), -std::sin(tilt)});
  EXPECT_NEAR(rig.Tilt(), tilt, 1e-14);
  EXPECT_NEAR(rig.Roll(), 0, 1e-14);
}

TEST(TurntableRig, TurningCounterClockwise_MovesTheFrontToTheRight) {
  const TurntableRig rig = SquareOnRig(600);
  const Eigen::Vector3d front(50, 0, 0);  // towards the camera
  EXPECT_GT((rig.CameraFromDisk(5 * kDegree) * front).x(), (rig.CameraFromDisk(0) * front).x());
}

TEST(Rectification, OfARig_SeesPointsInOneRowAndTriangulatesThem) {
  TurntableRig rig = RigFromAxis(DistortedCamera(), {4, 20, 600}, {0.02, -1, -0.15});
  const double left_angle = 34 * kDegree, right_angle = 30 * kDegree;
  const StereoPair pair = rig.Pair(left_angle, right_angle);
  for (const Rectification& normal : {Rectify(pair), Rectify(pair, Eigen::Vector3d(4, 20, 600))}) {
    EXPECT_NEAR(normal.baseline, 2 * rig.AxisDistance() * std::sin(2 * kDegree), 1e-9);
    for (const Eigen::Vector3d& p : kScene) {
      const Eigen::Vector3d left = rig.CameraFromDisk(left_angle) * p;
      const Eigen::Vector3d right = rig.CameraFromDisk(right_angle) * p;
      const Eigen::Vector3d l = normal.rotation[0] * left, r = normal.rotation[1] * right;
      const double x_left = normal.f * l.x() / l.z() + normal.cx[0];
      const double x_right = normal.f * r.x() / r.z() + normal.cx[1];
      EXPECT_NEAR(l.y() / l.z(), r.y() / r.z(), 1e-13);
      const Eigen::Vector3d seen = normal.Project(left);
      EXPECT_NEAR(seen.x(), x_left, 1e-9);
      EXPECT_NEAR(seen.z(), x_left - x_right, 1e-9);
      EXPECT_LT((normal.Triangulate(seen.x(), seen.y(), seen.z()) - left).norm(), 1e-8);
    }
  }
}

TEST(Rectification, SquareOn_IsEqs4To7) {
  const double d = 600, phi = 4 * kDegree;
  const TurntableRig rig = SquareOnRig(d);
  // Fig. 1: the object turned by ∓φ/2 from square on.
  const Rectification normal = Rectify(rig.Pair(phi / 2, -phi / 2));
  const Eigen::Vector2d principal(400, 300);
  for (const Eigen::Vector3d& p : kScene) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const Eigen::Vector3d seen = rig.CameraFromDisk(side == 0 ? phi / 2 : -phi / 2) * p;
      const Eigen::Vector2d pixel = rig.camera.Project(seen) - principal;
      const Eigen::Vector2d paper =
          side == 0 ? SquareOnNormalLeft(2000, phi, pixel) : SquareOnNormalRight(2000, phi, pixel);
      const Eigen::Vector3d general = normal.rotation[side] * seen;
      EXPECT_NEAR(paper.x(), 2000 * general.x() / general.z(), 1e-9);
      EXPECT_NEAR(paper.y(), 2000 * general.y() / general.z(), 1e-9);
    }
  }
}

TEST(Rectification, EqsOneToThree_GiveCoordinatesFromTheLeftCentre) {
  const double d = 600, phi = 4 * kDegree, f = 2000;
  const TurntableRig rig = SquareOnRig(d);
  const Eigen::Vector2d principal(400, 300);
  // In the frame of Fig. 1: the axis is the origin, x to the right, z away, y down; C_L of MATH.md §3.
  const Eigen::Vector3d left_centre(-d * std::sin(phi / 2), 0, -d * std::cos(phi / 2));
  for (const Eigen::Vector3d& p : kScene) {
    const Eigen::Vector2d left =
        SquareOnNormalLeft(f, phi, rig.camera.Project(rig.CameraFromDisk(phi / 2) * p) - principal);
    const Eigen::Vector2d right =
        SquareOnNormalRight(f, phi, rig.camera.Project(rig.CameraFromDisk(-phi / 2) * p) - principal);
    const double scale = 2 * d * std::sin(phi / 2) / (left.x() - right.x());
    const Eigen::Vector3d point = scale * Eigen::Vector3d(left.x(), left.y(), f) + left_centre;
    const Eigen::Vector3d truth(p.y(), -p.z(), -p.x());  // the disk's frame in Fig. 1's
    EXPECT_LT((point - truth).norm(), 1e-8);
  }
}

TEST(Rectification, RangeSlope_IsTheDerivativeOfTheDistance) {
  const Rectification normal = Rectify(SquareOnRig(600).Pair(2 * kDegree, -2 * kDegree));
  const double step = 1e-4;
  const double x = 380, y = 250, disparity = normal.Project({5, 5, 580}).z();
  const double slope = (normal.Triangulate(x, y, disparity + step).norm() -
                        normal.Triangulate(x, y, disparity - step).norm()) /
                       (2 * step);
  EXPECT_NEAR(normal.RangeSlope(x, y, disparity), slope, 1e-6 * std::abs(slope));
}

TEST(Rectification, OfASwappedPair_SaysSo) {
  try {
    (void)Rectify(SquareOnRig(600).Pair(-2 * kDegree, 2 * kDegree));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("swapped"), std::string::npos) << error.what();
  }
}

TEST(Rectification, WithoutBaseline_IsRefused) {
  EXPECT_THROW((void)Rectify(SquareOnRig(600).Pair(0.1, 0.1)), InputError);
}

}  // namespace
}  // namespace frond
