// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/integer_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/errors.h"
#include "problems/stereo/pyramid_correlation.h"

namespace frond {
namespace {

constexpr int kFinestForRange = 2;   // the range is found on a quarter of the image's size
constexpr float kSureMatch = 0.85f;  // correlation of the disparities that tell the range
constexpr int kMostNeighbours = 5;   // of 8, and the pixel itself
constexpr std::size_t kFewest = 50;  // of them
constexpr std::size_t kTail = 200;   // 1/200 of them at each end is left out

// Whether most of the 8 neighbours have the displacement too, to a pixel: chance matches stand alone.
bool IsSupported(const Image& u, int x, int y) {
  int support = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      if (u.Contains(x + i, y + j) && std::abs(u(x + i, y + j) - u(x, y)) <= 1) ++support;
    }
  }
  return support > kMostNeighbours;
}

void ClearOutside(const Mask& mask, Image& disparity) {
  if (mask.empty()) return;
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    if (!mask.values[i]) disparity.values[i] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

std::array<int, 2> DisparityRange(const Image& left, const Image& right, const Mask& left_mask,
                                  const Mask& right_mask, int threads) {
  const SearchRange all{{-left.width / 2, left.width / 2}, {0, 0}};
  const int finest = std::min(kFinestForRange, CoarsestLevel(left, all));
  const IntegerDisplacements found =
      CorrelatePyramid(left, right, left_mask, right_mask, all, finest, threads);
  std::vector<float> disparities;
  for (int y = 0; y < found.u.height; ++y) {
    for (int x = 0; x < found.u.width; ++x) {
      if (found.correlation(x, y) > kSureMatch && IsSupported(found.u, x, y)) {
        disparities.push_back(-found.u(x, y));
      }
    }
  }
  if (disparities.size() < kFewest) {
    throw InputError("the images have hardly anything in common (" + std::to_string(disparities.size()) +
                     " places match on a reduced pair): check that they show the same object, or give the "
                     "range of disparities");
  }
  std::sort(disparities.begin(), disparities.end());
  const std::size_t tail = disparities.size() / kTail;
  const int scale = 1 << finest;
  const int smallest = static_cast<int>(disparities[tail]) * scale,
            largest = static_cast<int>(disparities[disparities.size() - 1 - tail]) * scale;
  const int margin = 2 * scale + (largest - smallest) / 4;
  return {smallest - margin, largest + margin};
}

IntegerStart StartDisparities(const Image& left, const Image& right, const Mask& left_mask,
                              const Mask& right_mask, MatchStart start,
                              const std::optional<std::array<int, 2>>& range, int threads) {
  IntegerStart result;
  result.range = range ? *range : DisparityRange(left, right, left_mask, right_mask, threads);
  if (start == MatchStart::kSgbm) {
    result.disparity = SemiGlobalDisparity(left, right, result.range);
  } else {
    const SearchRange search{{-result.range[1], -result.range[0]}, {0, 0}};
    result.disparity = CorrelatePyramid(left, right, left_mask, right_mask, search, 0, threads).u;
    for (float& value : result.disparity.values) value = -value;
  }
  ClearOutside(left_mask, result.disparity);
  return result;
}

}  // namespace frond
