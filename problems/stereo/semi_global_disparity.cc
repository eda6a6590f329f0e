// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "problems/stereo/integer_start.h"

namespace frond {
namespace {

constexpr int kBlock = 5;       // side of the blocks whose costs are summed, pixels
constexpr int kUniqueness = 5;  // the best cost is this many per cent better than the second
constexpr int kSpeckle = 50;    // smaller patches of one disparity are noise, pixels
constexpr int kSubPixel = 16;   // OpenCV's disparities are in sixteenths

cv::Mat EightBit(const Image& image) {
  cv::Mat grey(image.height, image.width, CV_8UC1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      grey.at<unsigned char>(y, x) =
          static_cast<unsigned char>(std::clamp(std::lround(image(x, y)), 0L, 255L));
    }
  }
  return grey;
}

}  // namespace

Image SemiGlobalDisparity(const Image& left, const Image& right, const std::array<int, 2>& range) {
  const int count = (range[1] - range[0] + 16) / 16 * 16;  // the least multiple of 16 that holds the range
  const int smallest = range[0], largest = smallest + count;
  // OpenCV leaves out columns whose counterpart of *any* disparity lies outside: borders keep them in.
  const int before = std::max(largest, 0), after = std::max(-smallest, 0);
  cv::Mat l, r, disparity;
  cv::copyMakeBorder(EightBit(left), l, 0, 0, before, after, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(EightBit(right), r, 0, 0, before, after, cv::BORDER_REPLICATE);
  const int area = kBlock * kBlock;
  cv::StereoSGBM::create(smallest, count, kBlock, 8 * area, 32 * area, 1, 63, kUniqueness, kSpeckle, 2,
                         cv::StereoSGBM::MODE_SGBM)
      ->compute(l, r, disparity);
  Image result(left.width, left.height, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const short value = disparity.at<short>(y, x + before);
      if (value < smallest * kSubPixel) continue;
      const float d = static_cast<float>(value) / static_cast<float>(kSubPixel);
      const float counterpart = static_cast<float>(x) - d;
      if (counterpart < 0 || counterpart > static_cast<float>(right.width - 1)) continue;
      result(x, y) = d;
    }
  }
  return result;
}

}  // namespace frond
