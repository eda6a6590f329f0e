// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/pair_checks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.h"

namespace frond {
namespace {

constexpr float kBlack = 10, kSaturated = 250;  // grey levels
constexpr double kMostBlack = 0.995;            // share of the object's pixels
constexpr double kMostSaturated = 1.0 / 3;
constexpr int kSmallestSide = 16;  // pixels
constexpr double kMostNegative = 0.95;
constexpr float kClearlyNegative = -1;  // pixels, the median

std::string Size(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

std::string Percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void CheckMask(const Image& image, const Mask& mask, const std::string& name) {
  if (mask.empty()) return;
  if (mask.width != image.width || mask.height != image.height) {
    throw InputError("the mask of " + name + " is " + std::to_string(mask.width) + " x " +
                     std::to_string(mask.height) + ", the image " + Size(image) +
                     ": give a mask of the image's size");
  }
  if (std::none_of(mask.values.begin(), mask.values.end(), [](std::uint8_t value) { return value != 0; })) {
    throw InputError("the mask of " + name + " is empty: no pixel belongs to the object");
  }
}

void CheckGrey(const Image& image, const Mask& mask, const std::string& name) {
  std::size_t count = 0, black = 0, saturated = 0;
  float least = 255, most = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (!mask.empty() && !mask.values[i]) continue;
    const float grey = image.values[i];
    ++count;
    if (grey <= kBlack) ++black;
    if (grey >= kSaturated) ++saturated;
    least = std::min(least, grey);
    most = std::max(most, grey);
  }
  const std::string where = mask.empty() ? " of its pixels " : " of the object's pixels ";
  const double all = static_cast<double>(count);
  if (static_cast<double>(black) > kMostBlack * all) {
    throw InputError(name + " is black: " + Percent(static_cast<double>(black) / all) + where +
                     "are at grey level 10 or below; expose longer, or check the file");
  }
  if (static_cast<double>(saturated) > kMostSaturated * all) {
    throw InputError(name + " is saturated: " + Percent(static_cast<double>(saturated) / all) + where +
                     "are at grey level 250 or above; expose shorter");
  }
  if (most - least < 1) throw InputError(name + " is of one grey level: there is nothing to match");
}

}  // namespace

void CheckPair(const Image& left, const Image& right, const Mask& left_mask, const Mask& right_mask,
               const std::array<std::string, 2>& names) {
  if (left.width != right.width || left.height != right.height) {
    throw InputError(names[0] + " is " + Size(left) + ", " + names[1] + " " + Size(right) +
                     ": the images of a pair have the same size");
  }
  if (left.width < kSmallestSide || left.height < kSmallestSide) {
    throw InputError(names[0] + " is " + Size(left) + ": too small to be matched");
  }
  CheckMask(left, left_mask, names[0]);
  CheckMask(right, right_mask, names[1]);
  CheckGrey(left, left_mask, names[0]);
  CheckGrey(right, right_mask, names[1]);
}

void CheckSides(const Image& disparity, const std::array<std::string, 2>& names) {
  std::vector<float> values;
  for (const float value : disparity.values) {
    if (!std::isnan(value)) values.push_back(value);
  }
  if (values.empty()) return;
  const auto negative = std::count_if(values.begin(), values.end(), [](float value) { return value < 0; });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double share = static_cast<double>(negative) / static_cast<double>(values.size());
  if (share < kMostNegative || *middle > kClearlyNegative) return;
  throw InputError("the pair is swapped: " + Percent(share) + " of the disparities are negative (" +
                   std::to_string(std::lround(*middle)) + " pixels in the middle), as if " + names[1] +
                   " were the left one; exchange the images, or give the range of disparities if they are "
                   "meant to be negative");
}

}  // namespace frond
