// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/object_mask.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/errors.h"

namespace frond {
namespace {

// Between the mean grey levels of object and background; below this a threshold parts noise from noise.
constexpr double kLeastContrast = 10;

cv::Mat Levels(const Image& image) {
  const cv::Mat grey(image.height, image.width, CV_32F, const_cast<float*>(image.values.data()));
  cv::Mat levels;
  grey.convertTo(levels, CV_8U);
  return levels;
}

bool MostOfBorderIsBright(const cv::Mat& bright) {
  const int border = cv::countNonZero(bright.row(0)) + cv::countNonZero(bright.row(bright.rows - 1)) +
                     cv::countNonZero(bright.col(0)) + cv::countNonZero(bright.col(bright.cols - 1));
  return border > bright.rows + bright.cols;
}

cv::Mat LargestPart(const cv::Mat& object) {
  cv::Mat labels, statistics, centres;
  const int parts = cv::connectedComponentsWithStats(object, labels, statistics, centres, 8);
  int largest = 0;
  for (int part = 1; part < parts; ++part) {
    const auto area = [&](int k) { return statistics.at<int>(k, cv::CC_STAT_AREA); };
    if (largest == 0 || area(part) > area(largest)) largest = part;
  }
  return largest == 0 ? cv::Mat::zeros(object.size(), CV_8U) : cv::Mat(labels == largest);
}

// What the background cannot reach from the image's border.
cv::Mat WithoutHoles(const cv::Mat& object) {
  cv::Mat padded, reached;
  cv::copyMakeBorder(object, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::floodFill(padded, cv::Point(0, 0), cv::Scalar(128));
  reached = padded == 128;
  return ~reached(cv::Rect(1, 1, object.cols, object.rows));
}

cv::Mat ObjectSide(const cv::Mat& levels, BackgroundKind background, const std::string& name) {
  cv::Mat bright;
  cv::threshold(levels, bright, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const double contrast = cv::mean(levels, bright)[0] - cv::mean(levels, ~bright)[0];
  const int count = cv::countNonZero(bright);
  if (!(contrast >= kLeastContrast) || count == 0 || count == static_cast<int>(bright.total())) {
    throw InputError(name + ": the object cannot be told from its background, the image has no contrast " +
                     "(black or saturated?); give masks in the list of views");
  }
  if (background == BackgroundKind::kAuto) {
    background = MostOfBorderIsBright(bright) ? BackgroundKind::kLight : BackgroundKind::kDark;
  }
  return background == BackgroundKind::kLight ? cv::Mat(~bright) : bright;
}

}  // namespace

Mask FindObjectMask(const Image& image, const ObjectMaskOptions& options, const std::string& name) {
  if (image.empty()) throw InputError(name + ": the image is empty");
  if (options.background == BackgroundKind::kNone) return Mask(image.width, image.height, 1);
  cv::Mat object = ObjectSide(Levels(image), options.background, name);
  if (options.opening > 0) {
    const int size = 2 * static_cast<int>(std::ceil(options.opening)) + 1;
    const cv::Mat disk = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(size, size));
    cv::morphologyEx(object, object, cv::MORPH_OPEN, disk);
  }
  object = WithoutHoles(LargestPart(object));
  Mask mask(image.width, image.height, 0);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) mask(x, y) = object.at<std::uint8_t>(y, x) != 0 ? 1 : 0;
  }
  if (MaskShare(mask) < options.least_share) {
    throw InputError(name + ": no object is found before the background; give masks in the list of views");
  }
  return mask;
}

double MaskShare(const Mask& mask) {
  double sum = 0;
  for (const std::uint8_t value : mask.values) sum += value != 0 ? 1 : 0;
  return mask.empty() ? 0 : sum / static_cast<double>(mask.values.size());
}

}  // namespace frond
