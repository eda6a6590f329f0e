// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/pyramid_correlation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace frond {
namespace {

constexpr int kHalfWindow = 4;
constexpr int kLeastPixels = 27;                    // a third of the window's
constexpr int kSmallSide = 80, kSmallestSide = 32;  // of the coarsest level
constexpr int kMostTries = 400;                     // of displacements for each pixel there
constexpr float kLeastTexture = 1;                  // standard deviation of grey in the window
constexpr float kLeastMatch = 0.5f;                 // correlation
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct Level {
  Image left = {}, right = {};
  Mask left_mask = {}, right_mask = {};
};

bool Counts(const Mask& mask, int x, int y) { return mask.empty() || mask(x, y) != 0; }

// Every second pixel of the image smoothed by (1 4 6 4 1)/16 both ways, of the mask's pixels alone.
std::pair<Image, Mask> Halved(const Image& image, const Mask& mask) {
  static constexpr std::array<float, 5> kBinomial = {1, 4, 6, 4, 1};
  Image half((image.width + 1) / 2, (image.height + 1) / 2);
  Mask half_mask;
  if (!mask.empty()) half_mask = Mask(half.width, half.height);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      float sum = 0, weights = 0;
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          const int column = 2 * x + i, row = 2 * y + j;
          if (!image.Contains(column, row) || !Counts(mask, column, row)) continue;
          const float weight =
              kBinomial[static_cast<std::size_t>(i + 2)] * kBinomial[static_cast<std::size_t>(j + 2)];
          sum += weight * image(column, row);
          weights += weight;
        }
      }
      if (weights > 0) half(x, y) = sum / weights;
      if (!mask.empty()) half_mask(x, y) = Counts(mask, 2 * x, 2 * y) ? 1 : 0;
    }
  }
  return {std::move(half), std::move(half_mask)};
}

// The window round one pixel of the left image, for its correlation with many of the right one.
class LeftWindow {
 public:
  LeftWindow(const Level& level, int x, int y) : level_(level), x_(x), y_(y) {
    float sum = 0;
    for (int j = -kHalfWindow; j <= kHalfWindow; ++j) {
      for (int i = -kHalfWindow; i <= kHalfWindow; ++i) {
        if (!level.left.Contains(x + i, y + j) || !Counts(level.left_mask, x + i, y + j)) continue;
        const std::size_t k = static_cast<std::size_t>(count_++);
        offset_[k] = {i, j};
        grey_[k] = level.left(x + i, y + j);
        sum += grey_[k];
      }
    }
    const float mean = sum / static_cast<float>(std::max(count_, 1));
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
      grey_[k] -= mean;
      square_ += grey_[k] * grey_[k];
    }
  }

  bool HasTexture() const {
    return count_ >= kLeastPixels && square_ > kLeastTexture * kLeastTexture * static_cast<float>(count_);
  }

  // −1 where the window's counterpart is not wholly inside the right image, or its centre is masked.
  float Correlation(int u, int v) const {
    const int x = x_ + u, y = y_ + v;
    const Image& right = level_.right;
    if (!right.Contains(x, y) || !Counts(level_.right_mask, x, y)) return -1;
    float sum = 0, squares = 0, products = 0;
    int count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
      const int column = x + offset_[k][0], row = y + offset_[k][1];
      if (!right.Contains(column, row)) continue;
      const float grey = right(column, row);
      sum += grey;
      squares += grey * grey;
      products += grey * grey_[k];
      ++count;
    }
    if (count < count_) return -1;
    const float spread = squares - sum * sum / static_cast<float>(count);
    if (!(spread > kLeastTexture * kLeastTexture * static_cast<float>(count))) return -1;
    return products / std::sqrt(spread * square_);
  }

 private:
  static constexpr std::size_t kMost = (2 * kHalfWindow + 1) * (2 * kHalfWindow + 1);
  const Level& level_;
  int x_, y_, count_ = 0;
  std::array<std::array<int, 2>, kMost> offset_{};
  std::array<float, kMost> grey_{};  // less its mean
  float square_ = 0;
};

// Keeps the best of the displacements that it is shown.
struct Best {
  int u = 0, v = 0;
  float correlation = -1;
  void Try(const LeftWindow& window, int candidate_u, int candidate_v) {
    const float value = window.Correlation(candidate_u, candidate_v);
    if (value > correlation) *this = {candidate_u, candidate_v, value};
  }
};

Best SearchAll(const LeftWindow& window, const SearchRange& range) {
  Best best;
  for (int v = range.v[0]; v <= range.v[1]; ++v) {
    for (int u = range.u[0]; u <= range.u[1]; ++u) best.Try(window, u, v);
  }
  return best;
}

// Next to twice the displacements of the 3×3 coarser pixels round (x, y).
Best SearchNear(const LeftWindow& window, const IntegerDisplacements& coarser, int x, int y,
                const SearchRange& range) {
  std::array<std::array<int, 2>, 9> seen{};
  std::size_t count = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int column = x / 2 + i, row = y / 2 + j;
      if (!coarser.u.Contains(column, row) || std::isnan(coarser.u(column, row))) continue;
      const std::array<int, 2> twice = {2 * static_cast<int>(coarser.u(column, row)),
                                        2 * static_cast<int>(coarser.v(column, row))};
      if (std::find(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), twice) ==
          seen.begin() + static_cast<std::ptrdiff_t>(count)) {
        seen[count++] = twice;
      }
    }
  }
  Best best;
  const int around_v = range.v[0] == range.v[1] ? 0 : 1;
  for (std::size_t k = 0; k < count; ++k) {
    for (int v = -around_v; v <= around_v; ++v) {
      for (int u = -1; u <= 1; ++u) best.Try(window, seen[k][0] + u, seen[k][1] + v);
    }
  }
  return best;
}

// Of left pixels that claim the same right pixel, the best correlated one stays, with its neighbours along x.
void KeepUncontested(const Level& level, IntegerDisplacements& found) {
  Raster<float> best(level.right.width, level.right.height, -1);
  const auto claimed = [&](int x, int y) {
    return std::array<int, 2>{x + static_cast<int>(found.u(x, y)), y + static_cast<int>(found.v(x, y))};
  };
  Raster<int> owner_u(level.right.width, level.right.height, 0);
  for (int y = 0; y < found.u.height; ++y) {
    for (int x = 0; x < found.u.width; ++x) {
      if (std::isnan(found.u(x, y))) continue;
      const auto [column, row] = claimed(x, y);
      if (found.correlation(x, y) <= best(column, row)) continue;
      best(column, row) = found.correlation(x, y);
      owner_u(column, row) = static_cast<int>(found.u(x, y));
    }
  }
  for (int y = 0; y < found.u.height; ++y) {
    for (int x = 0; x < found.u.width; ++x) {
      if (std::isnan(found.u(x, y))) continue;
      const auto [column, row] = claimed(x, y);
      if (std::abs(owner_u(column, row) - static_cast<int>(found.u(x, y))) > 1) found.u(x, y) = kNone;
    }
  }
}

SearchRange RangeAt(const SearchRange& range, int level) {
  const int scale = 1 << level;
  const auto down = [&](int value) {
    return static_cast<int>(std::floor(static_cast<double>(value) / static_cast<double>(scale)));
  };
  const auto up = [&](int value) {
    return static_cast<int>(std::ceil(static_cast<double>(value) / static_cast<double>(scale)));
  };
  return {{down(range.u[0]), up(range.u[1])}, {down(range.v[0]), up(range.v[1])}};
}

IntegerDisplacements SearchLevel(const Level& level, const IntegerDisplacements* coarser,
                                 const SearchRange& range, int threads) {
  const int width = level.left.width, height = level.left.height;
  IntegerDisplacements found{Image(width, height, kNone), Image(width, height, kNone),
                             Image(width, height, kNone)};
  ParallelFor(static_cast<std::size_t>(height), 8, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        if (!Counts(level.left_mask, x, y)) continue;
        const LeftWindow window(level, x, y);
        if (!window.HasTexture()) continue;
        const Best best = coarser ? SearchNear(window, *coarser, x, y, range) : SearchAll(window, range);
        if (best.correlation < kLeastMatch) continue;
        found.u(x, y) = static_cast<float>(best.u);
        found.v(x, y) = static_cast<float>(best.v);
        found.correlation(x, y) = best.correlation;
      }
    }
  });
  KeepUncontested(level, found);
  return found;
}

}  // namespace

int CoarsestLevel(const Image& image, const SearchRange& range) {
  int level = 0;
  for (int side = std::min(image.width, image.height);; side /= 2, ++level) {
    const SearchRange here = RangeAt(range, level);
    const int tries = (here.u[1] - here.u[0] + 1) * (here.v[1] - here.v[0] + 1);
    if (side / 2 < (tries > kMostTries ? kSmallestSide : kSmallSide)) return level;
  }
}

IntegerDisplacements CorrelatePyramid(const Image& left, const Image& right, const Mask& left_mask,
                                      const Mask& right_mask, const SearchRange& range, int finest,
                                      int threads) {
  std::vector<Level> levels(1);
  levels[0] = {left, right, left_mask, right_mask};
  const int coarsest = std::max(CoarsestLevel(left, range), finest);
  for (int k = 0; k < coarsest; ++k) {
    const Level& finer = levels.back();
    Level next;
    std::tie(next.left, next.left_mask) = Halved(finer.left, finer.left_mask);
    std::tie(next.right, next.right_mask) = Halved(finer.right, finer.right_mask);
    levels.push_back(std::move(next));
  }
  IntegerDisplacements found;
  for (int k = coarsest; k >= finest; --k) {
    found = SearchLevel(levels[static_cast<std::size_t>(k)], k == coarsest ? nullptr : &found,
                        RangeAt(range, k), threads);
  }
  return found;
}

}  // namespace frond
