// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/stereo_calibration.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/errors.h"
#include "problems/turntable/board_detection.h"
#include "tests/problems/turntable/board_views.h"

namespace frond {
namespace {

// Two cameras 80 units apart that look at a board in `count` positions.
StereoPair ExamplePair() {
  StereoPair pair{.left = ExampleCamera(), .right = ExampleCamera()};
  pair.right.focal = {1980, 1990, 650, 500};
  pair.right.distortion = {-0.15, 0.1, 0.001, -0.0005, 0};
  pair.right_from_left.linear() =
      Eigen::AngleAxisd(-8 * kDegree, Eigen::Vector3d(0.05, 1, 0.02).normalized()).toRotationMatrix();
  pair.right_from_left.translation() = Eigen::Vector3d(-80, 1, 4);
  return pair;
}

std::vector<BoardPair> ExamplePairs(const StereoPair& pair, const Board& board, int count, double noise,
                                    Random* random) {
  std::vector<BoardPair> pairs;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d about(std::cos(2.4 * k), std::sin(2.4 * k), 0.2);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(0.5, about.normalized()).toRotationMatrix();
    const Eigen::Vector3d centre(0.5 * (board.columns - 1) * board.square,
                                 0.5 * (board.rows - 1) * board.square, 0);
    pose.translation() = Eigen::Vector3d(45 * std::cos(1.7 * k), 40 * std::sin(1.7 * k), 560 + 10 * k) -
                         pose.linear() * centre;
    pairs.push_back({.left = SeenCorners(pair.left, pose, board, noise, random),
                     .right = SeenCorners(pair.right, pair.right_from_left * pose, board, noise, random),
                     .name = "pair" + std::to_string(k)});
  }
  return pairs;
}

const Board kBoard{.columns = 9, .rows = 6, .square = 15};

TEST(StereoCalibrationTest, Pair_WithoutNoise_IsFoundExactly) {
  Random random(1);
  const StereoPair truth = ExamplePair();
  const auto found = CalibrateStereo(ExamplePairs(truth, kBoard, 12, 0, &random), 1280, 1024, {});
  EXPECT_LT(found.rms, 1e-7);
  EXPECT_TRUE(found.pair.right_from_left.isApprox(truth.right_from_left, 1e-7));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(found.pair.left.focal[k], truth.left.focal[k], 1e-4);
    EXPECT_NEAR(found.pair.right.focal[k], truth.right.focal[k], 1e-4);
  }
}

TEST(StereoCalibrationTest, Errors_AreTheReportedDeviations) {
  constexpr int kSeeds = 12;
  const StereoPair truth = ExamplePair();
  double sum = 0;
  int count = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 1);
    const auto found = CalibrateStereo(ExamplePairs(truth, kBoard, 12, 0.1, &random), 1280, 1024, {});
    for (std::size_t k = 0; k < 3; ++k, ++count) {
      const auto axis = static_cast<Eigen::Index>(k);
      sum += std::pow(
          (found.pair.right_from_left.translation()[axis] - truth.right_from_left.translation()[axis]) /
              found.pose_sigma[3 + k],
          2);
    }
    for (std::size_t k = 0; k < 4; ++k, ++count) {
      sum += std::pow((found.pair.right.focal[k] - truth.right.focal[k]) / found.right_sigma[k], 2);
    }
  }
  // Correlated, so about as good as 2 independent draws a seed.
  EXPECT_NEAR(std::sqrt(sum / count), 1, 2.5 * std::sqrt(0.5 / (2 * kSeeds)));
}

TEST(StereoCalibrationTest, Pairs_OfAHalfTurnSymmetricBoard_AreMatchedAcrossTheCameras) {
  Random random(2);
  const StereoPair truth = ExamplePair();
  auto pairs = ExamplePairs(truth, {.columns = 8, .rows = 6, .square = 15}, 12, 0.1, &random);
  pairs[3].right = TurnedUpsideDown(pairs[3].right);
  pairs[8].right = TurnedUpsideDown(pairs[8].right);
  const auto found = CalibrateStereo(pairs, 1280, 1024, {});
  EXPECT_LT(found.rms, 0.15);
  EXPECT_LT((found.pair.right_from_left.translation() - truth.right_from_left.translation()).norm(), 1);
}

TEST(StereoCalibrationTest, ABadView_IsNamed) {
  Random random(3);
  auto pairs = ExamplePairs(ExamplePair(), kBoard, 14, 0.1, &random);
  for (std::size_t k = 0; k < pairs[5].right.pixels.size(); k += 2) pairs[5].right.pixels[k].y() += 3;
  const auto found = CalibrateStereo(pairs, 1280, 1024, {});
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_EQ(found.warnings[0].rfind("pair5 (", 0), 0u) << found.warnings[0];
}

// The 13 pairs of OpenCV's sample: 9x6 corners, squares of 25 mm.
std::vector<BoardPair> SamplePairs(const std::filesystem::path& folder, cv::Size* size) {
  const Board board{.columns = 9, .rows = 6, .square = 25};
  std::vector<BoardPair> pairs;
  for (int k = 1; k <= 14; ++k) {
    char number[8];
    std::snprintf(number, sizeof number, "%02d.jpg", k);
    if (!std::filesystem::exists(folder / ("left" + std::string(number)))) continue;
    BoardPair pair{.name = number};
    for (const bool left : {true, false}) {
      const std::string file = (left ? "left" : "right") + std::string(number);
      const cv::Mat grey = cv::imread((folder / file).string(), cv::IMREAD_GRAYSCALE);
      Image image(grey.cols, grey.rows);
      for (int y = 0; y < grey.rows; ++y) {
        for (int x = 0; x < grey.cols; ++x) image(x, y) = grey.at<unsigned char>(y, x);
      }
      *size = grey.size();
      const auto corners = DetectBoard(image, board);
      EXPECT_TRUE(corners.has_value()) << file;
      if (corners) (left ? pair.left : pair.right) = *corners;
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

double RmsOfOpencv(const std::vector<BoardPair>& pairs, cv::Size size, int flags) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> left, right;
  for (const BoardPair& pair : pairs) {
    points.emplace_back();
    left.emplace_back();
    right.emplace_back();
    for (std::size_t i = 0; i < pair.left.points.size(); ++i) {
      const Eigen::Vector3f p = pair.left.points[i].cast<float>();
      const Eigen::Vector2f l = pair.left.pixels[i].cast<float>(), r = pair.right.pixels[i].cast<float>();
      points.back().emplace_back(p.x(), p.y(), p.z());
      left.back().emplace_back(l.x(), l.y());
      right.back().emplace_back(r.x(), r.y());
    }
  }
  cv::Mat K1 = cv::initCameraMatrix2D(points, left, size, 1),
          K2 = cv::initCameraMatrix2D(points, right, size, 1);
  cv::Mat D1, D2, R, T, E, F;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 300, 1e-10);
  return cv::stereoCalibrate(points, left, right, K1, D1, K2, D2, size, R, T, E, F, flags, until);
}

TEST(StereoCalibrationTest, ChessboardPairs_OfOpencvsSample_AreFittedNoWorseThanByOpencv) {
  const std::filesystem::path folder = std::string(FROND_SHARED_DATA) + "/stereo/chessboard_opencv";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  cv::Size size;
  const std::vector<BoardPair> pairs = SamplePairs(folder, &size);
  ASSERT_EQ(pairs.size(), 13u);
  struct Model {
    const char* name;
    StereoCalibrationOptions options;
    int flags;
  };
  const Model models[] = {
      {"all free", {}, 0},
      {"k3 held", {.radial_distortion = 2}, cv::CALIB_FIX_K3},
      {"no tangential, k3 held",
       {.tangential_distortion = false, .radial_distortion = 2},
       cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K3},
      {"square pixels, same focal length, no tangential, k3 held",
       {.square_pixels = true,
        .tangential_distortion = false,
        .radial_distortion = 2,
        .same_focal_length = true},
       cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_USE_INTRINSIC_GUESS | cv::CALIB_SAME_FOCAL_LENGTH |
           cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K3},
  };
  for (const Model& model : models) {
    const StereoCalibration found = CalibrateStereo(pairs, size.width, size.height, model.options);
    const double opencv = RmsOfOpencv(pairs, size, model.flags);
    const Eigen::Vector3d t = found.pair.right_from_left.translation();
    std::printf("%s: RMS %.6f px, OpenCV %.6f px; baseline %.3f +- %.3f mm\n", model.name, found.rms, opencv,
                t.norm(), found.pose_sigma[3]);
    EXPECT_LE(found.rms, opencv + 1e-6) << model.name;  // OpenCV's own sum is in single precision
    for (const std::string& warning : found.warnings) std::printf("  %s\n", warning.c_str());
  }
}

}  // namespace
}  // namespace frond
