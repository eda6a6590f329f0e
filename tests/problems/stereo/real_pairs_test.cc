// SPDX-License-Identifier: BSD-3-Clause
// Photographs with a known disparity, beside OpenCV's semi-global matching on the same pixels; and a loaded
// specimen beside another code's displacements.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/median.h"
#include "io/image_file.h"
#include "problems/stereo/stereo_matcher.h"

namespace frond {
namespace {

const std::filesystem::path kData = FROND_SHARED_DATA;

struct RealPair {
  const char* left;
  const char* right;
  const char* truth;
  double levels;  // of the truth, a pixel
  int most;       // disparity that semi-global matching looks for, a multiple of 16
};
void PrintTo(const RealPair& pair, std::ostream* out) { *out << pair.left; }

cv::Mat Bytes(const Image& image) {
  cv::Mat bytes(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) bytes.at<uchar>(y, x) = cv::saturate_cast<uchar>(image(x, y));
  }
  return bytes;
}

// As OpenCV's own stereo_match sample sets it; NaN where it finds none.
Image SemiGlobal(const Image& left, const Image& right, int most) {
  constexpr int kBlock = 5;
  cv::Mat sixteenths;
  cv::StereoSGBM::create(0, most, kBlock, 8 * kBlock * kBlock, 32 * kBlock * kBlock, 1, 63, 10, 100, 32)
      ->compute(Bytes(left), Bytes(right), sixteenths);
  Image disparity(left.width, left.height, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const short value = sixteenths.at<short>(y, x);
      if (value >= 0) disparity(x, y) = static_cast<float>(value) / 16;
    }
  }
  return disparity;
}

struct Errors {
  std::size_t count = 0, bad = 0;
  double squares = 0;

  void Add(double error) {
    ++count;
    if (std::abs(error) > 1) ++bad;
    squares += error * error;
  }
  double Rmse() const { return std::sqrt(squares / static_cast<double>(count)); }
  double BadPercent() const { return 100 * static_cast<double>(bad) / static_cast<double>(count); }
};

class RealPairTest : public ::testing::TestWithParam<RealPair> {};

TEST_P(RealPairTest, AcceptedWindowsAreBetterThanSemiGlobalMatchingThere) {
  const RealPair& pair = GetParam();
  if (!std::filesystem::exists(kData / pair.left)) GTEST_SKIP() << "no " << pair.left << " in shared/data";
  const Image left = ReadImage(kData / pair.left), right = ReadImage(kData / pair.right);
  const Image truth = ReadRawImage(kData / pair.truth);
  const StereoMatches matches = MatchStereo(left, right, {}, {}, {}, 2);
  const Image peer = SemiGlobal(left, right, pair.most);
  Errors ours, theirs, dense;
  std::size_t known = 0, accepted = 0;
  for (const MatchedWindow& window : matches.windows) {
    if (truth(window.x, window.y) == 0) continue;
    ++known;
    if (window.status != WindowStatus::kAccepted) continue;
    ++accepted;
    const double disparity = truth(window.x, window.y) / pair.levels;
    if (std::isnan(peer(window.x, window.y))) continue;
    ours.Add(window.match.warp[0] - disparity);
    theirs.Add(peer(window.x, window.y) - disparity);
  }
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    if (truth.values[i] == 0) continue;
    ++pixels;
    if (std::isfinite(matches.disparity.values[i])) {
      dense.Add(matches.disparity.values[i] - truth.values[i] / pair.levels);
    }
  }
  const double share = static_cast<double>(accepted) / static_cast<double>(known);
  std::printf(
      "%s: accepted %.1f %%; on %zu pixels of both: bad 1 px %.2f %% (SGBM %.2f %%), RMSE %.3f (%.3f) px; "
      "dense %.1f %%, bad 1 px %.2f %%\n",
      pair.left, 100 * share, ours.count, ours.BadPercent(), theirs.BadPercent(), ours.Rmse(), theirs.Rmse(),
      100 * static_cast<double>(dense.count) / static_cast<double>(pixels), dense.BadPercent());
  EXPECT_GT(share, 0.5);
  EXPECT_LT(ours.BadPercent(), theirs.BadPercent());
  EXPECT_LT(ours.Rmse(), theirs.Rmse());
}

INSTANTIATE_TEST_SUITE_P(Pairs, RealPairTest,
                         ::testing::Values(RealPair{"stereo/aloe/aloeL.jpg", "stereo/aloe/aloeR.jpg",
                                                    "stereo/aloe/aloeGT.png", 1, 224},
                                           RealPair{"stereo/cones/im2.png", "stereo/cones/im6.png",
                                                    "stereo/cones/disp2.png", 4, 64}),
                         [](const auto& info) {
                           return std::filesystem::path(info.param.left).parent_path().filename().string();
                         });

struct DicePoint {
  double x, y, u, v;
};

std::vector<DicePoint> ReadDice(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<DicePoint> points;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '*' || line[0] == 'C') continue;
    for (char& c : line) {
      if (c == ',') c = ' ';
    }
    std::istringstream values(line);
    DicePoint point{};
    values >> point.x >> point.y >> point.u >> point.v;
    points.push_back(point);
  }
  return points;
}

// The images are cut out of DICe's: its setup leaves out a circle about (194, 543), the hole whose middle is
// (143.5, 472.5) here.
constexpr int kCutX = 50, kCutY = 70;

TEST(Specimen, Displacements_AgreeWithAnotherCode) {
  const std::filesystem::path folder = kData / "dic/oht_cfrp";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no dic/oht_cfrp in shared/data";
  const Image before = ReadImage(folder / "oht_cfrp_0.bmp"), after = ReadImage(folder / "oht_cfrp_4.bmp");
  StereoMatchOptions options;
  options.rectified = false;
  options.step = 10;
  options.window.size = 27;  // as DICe's
  options.window.warp = WarpKind::kAffine;
  options.start = MatchStart::kPyramid;
  std::vector<DicePoint> dice;
  std::vector<std::array<int, 2>> places;
  for (const DicePoint& point : ReadDice(folder / "dice_reference/DICe_solution_04.txt")) {
    const int x = static_cast<int>(std::lround(point.x)) - kCutX,
              y = static_cast<int>(std::lround(point.y)) - kCutY;
    if (!before.Contains(x, y)) continue;
    dice.push_back(point);
    places.push_back({x, y});
  }
  const std::vector<MatchedWindow> matches = MatchPoints(before, after, {}, {}, places, options, 2);
  std::vector<double> u, v;
  for (std::size_t k = 0; k < dice.size(); ++k) {
    if (matches[k].status != WindowStatus::kAccepted) continue;
    u.push_back(
        std::abs(-matches[k].match.warp[0] - dice[k].u));  // left minus right, DICe's right minus left
    v.push_back(std::abs(-matches[k].match.warp[3] - dice[k].v));
  }
  ASSERT_GT(u.size(), 150U);
  EXPECT_GT(static_cast<double>(u.size()), 0.95 * static_cast<double>(dice.size()));
  const double median_u = Median(std::move(u)), median_v = Median(std::move(v));
  std::printf("oht_cfrp: %zu points of DICe's in the image, median difference %.4f px in u, %.4f in v\n",
              dice.size(), median_u, median_v);
  EXPECT_LT(median_u, 0.05);
  EXPECT_LT(median_v, 0.05);
}

}  // namespace
}  // namespace frond
