// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board_detection.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "base/errors.h"
#include "tests/problems/turntable/board_views.h"

namespace frond {
namespace {

// An undistorted camera, so that a board's image is a homography of it.
PinholeCamera Camera() { return {.width = 640, .height = 480, .focal = {900, 900, 320, 240}}; }

// H from the board's plane to the image.
Eigen::Matrix3d Homography(const PinholeCamera& camera, const Eigen::Isometry3d& pose) {
  Eigen::Matrix3d K;
  K << camera.focal[0], 0, camera.focal[2], 0, camera.focal[1], camera.focal[3], 0, 0, 1;
  Eigen::Matrix3d plane;
  plane << pose.linear().col(0), pose.linear().col(1), pose.translation();
  return K * plane;
}

// A chessboard by 4 × 4 samples a pixel: the square (i, j) of the board's frame is black where i + j is even
// (the first inner one therefore), with a white margin beyond its outermost squares.
Image DrawChessboard(const PinholeCamera& camera, const Eigen::Isometry3d& pose, const Board& board) {
  const Eigen::Matrix3d inverse = Homography(camera, pose).inverse();
  Image image(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (int s = 0; s < 16; ++s) {
        const Eigen::Vector3d p =
            inverse * Eigen::Vector3d(x + (s % 4 - 1.5) / 4, y + (s / 4 - 1.5) / 4, 1.0);
        const double u = p.x() / p.z() / board.square, v = p.y() / p.z() / board.square;
        const bool inside = u > -1 && u < board.columns && v > -1 && v < board.rows;
        const bool black =
            inside && (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) % 2 == 0;
        sum += black ? 30 : 220;
      }
      image(x, y) = static_cast<float>(sum / 16);
    }
  }
  return image;
}

Eigen::Isometry3d Pose(const Eigen::Vector3d& rotation, const Eigen::Vector3d& centre, const Board& board) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0) {
    pose.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }
  pose.translation() = centre - pose.linear() * Eigen::Vector3d(0.5 * (board.columns - 1) * board.square,
                                                                0.5 * (board.rows - 1) * board.square, 0);
  return pose;
}

double RmsError(const BoardCorners& corners, const PinholeCamera& camera, const Eigen::Isometry3d& pose) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.pixels.size(); ++k) {
    sum += (camera.Project(pose * corners.points[k]) - corners.pixels[k]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(corners.pixels.size()));
}

double WorstError(const BoardCorners& corners, const PinholeCamera& camera, const Eigen::Isometry3d& pose) {
  double worst = 0;
  for (std::size_t k = 0; k < corners.pixels.size(); ++k) {
    worst = std::max(worst, (camera.Project(pose * corners.points[k]) - corners.pixels[k]).norm());
  }
  return worst;
}

TEST(BoardDetectionTest, Chessboard_TurnedInItsPlaneByAnyAngle_IsReadFromTheSameEnd) {
  for (const Board& board :
       {Board{.columns = 9, .rows = 6, .square = 10}, Board{.columns = 6, .rows = 9, .square = 10},
        Board{.columns = 7, .rows = 6, .square = 10}, Board{.columns = 4, .rows = 7, .square = 10}}) {
    for (int turn = 0; turn < 360; turn += 45) {
      const Eigen::Matrix3d tilted = (Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 0.4, 0).normalized()) *
                                      Eigen::AngleAxisd(turn * kDegree, Eigen::Vector3d::UnitZ()))
                                         .toRotationMatrix();
      const Eigen::AngleAxisd rotation(tilted);
      const auto pose = Pose(rotation.angle() * rotation.axis(), {3, -4, 300}, board);
      const auto corners = DetectBoard(DrawChessboard(Camera(), pose, board), board);
      ASSERT_TRUE(corners.has_value()) << BoardName(board) << " at " << turn;
      EXPECT_LT(RmsError(*corners, Camera(), pose), 0.08) << BoardName(board) << " at " << turn;
      EXPECT_LT(WorstError(*corners, Camera(), pose), 0.15) << BoardName(board) << " at " << turn;
      EXPECT_FALSE(corners->may_be_upside_down);
    }
  }
}

TEST(BoardDetectionTest, Chessboard_ThatLooksTheSameUpsideDown_SaysSo) {
  const Board board{.columns = 8, .rows = 6, .square = 10};
  const auto pose = Pose({0.3, 0.2, 0}, {0, 0, 320}, board);
  const auto corners = DetectBoard(DrawChessboard(Camera(), pose, board), board);
  ASSERT_TRUE(corners.has_value());
  EXPECT_TRUE(corners->may_be_upside_down);
  EXPECT_LT(
      std::min(WorstError(*corners, Camera(), pose), WorstError(TurnedUpsideDown(*corners), Camera(), pose)),
      0.15);
}

TEST(BoardDetectionTest, Charuco_PartlyCovered_GivesTheSeenCornersInTheBoardsFrame) {
  const Board board{.kind = Board::Kind::kCharuco, .columns = 7, .rows = 5, .square = 20, .marker = 15};
  const auto charuco = cv::aruco::CharucoBoard::create(
      7, 5, 20, 15, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat printed;
  charuco->draw({1400, 1000}, printed, 0, 1);  // 10 px a unit, whole board
  const auto pose = Pose({0.4, -0.3, 0.2}, {-5, 0, 330}, {.columns = 8, .rows = 6, .square = 20});
  Eigen::Matrix3d from_print = Eigen::Matrix3d::Identity();
  from_print.diagonal() << 0.1, 0.1, 1;
  from_print(0, 2) = from_print(1, 2) = 0.05;  // a print's pixel centres are at half units
  const Eigen::Matrix3d H = Homography(Camera(), pose) * from_print;
  cv::Mat seen, matrix(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix.at<double>(i, j) = H(i, j);
  }
  cv::GaussianBlur(printed, printed, {}, 2);  // no finer than the image's pixels
  cv::warpPerspective(printed, seen, matrix, {640, 480}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 200);
  Image image(640, 480);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) image(x, y) = seen.at<unsigned char>(y, x);
  }
  const auto whole = DetectBoard(image, board);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->pixels.size(), 24u);
  EXPECT_LT(RmsError(*whole, Camera(), pose), 0.1);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 300; ++x) image(x, y) = 200;
  }
  const auto part = DetectBoard(image, board);
  ASSERT_TRUE(part.has_value());
  EXPECT_GE(part->pixels.size(), 6u);
  EXPECT_LT(part->pixels.size(), 24u);
  EXPECT_LT(RmsError(*part, Camera(), pose), 0.1);
}

TEST(BoardDetectionTest, Images_WithoutTheBoard_GiveNothing) {
  const Board board{.columns = 9, .rows = 6, .square = 10};
  Random random(1);
  Image noise(320, 240);
  for (float& value : noise.values) value = static_cast<float>(255 * random.Uniform());
  for (const Image& image : {Image(), Image(320, 240, 0.0f), Image(320, 240, 255.0f), noise}) {
    EXPECT_FALSE(DetectBoard(image, board).has_value());
    EXPECT_FALSE(DetectBoard(image, {.kind = Board::Kind::kCharuco, .columns = 7, .rows = 5}).has_value());
  }
}

TEST(BoardDetectionTest, Boards_ThatCannotServe_AreRefused) {
  const Image image(64, 64);
  EXPECT_THROW(DetectBoard(image, {.columns = 6, .rows = 6}), ConfigError);
  EXPECT_THROW(DetectBoard(image, {.columns = 1, .rows = 6}), ConfigError);
  EXPECT_THROW(DetectBoard(image, {.square = 0}), ConfigError);
  EXPECT_THROW(DetectBoard(image, {.kind = Board::Kind::kCharuco, .marker = 1}), ConfigError);
  EXPECT_THROW(DetectBoard(image, {.kind = Board::Kind::kCharuco, .dictionary = "DICT_4x4_50"}), ConfigError);
  EXPECT_THROW(DetectBoard(image, {.kind = Board::Kind::kCharuco, .columns = 20, .rows = 20}), ConfigError);
}

TEST(BoardDetectionTest, Dictionaries_HaveTheMarkersThatOpencvHas) {
  for (const std::string& name : MarkerDictionaries()) {
    const auto dictionary = cv::aruco::getPredefinedDictionary(MarkerDictionaryNumber(name));
    const int markers = dictionary->bytesList.rows;
    // The widest board that the dictionary still holds, 2 rows more than half its markers.
    const Board fits{.kind = Board::Kind::kCharuco, .columns = markers / 2, .rows = 4, .dictionary = name};
    EXPECT_NO_THROW(CheckBoard(fits)) << name;
    const Board beyond{
        .kind = Board::Kind::kCharuco, .columns = markers / 2 + 1, .rows = 4, .dictionary = name};
    EXPECT_THROW(CheckBoard(beyond), ConfigError) << name;
  }
}

}  // namespace
}  // namespace frond
