// SPDX-License-Identifier: BSD-3-Clause
#include "models/cubic_image.h"

#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

// The pole of the inverse cubic B-spline filter, and its gain.
const double kPole = std::sqrt(3.0) - 2;
constexpr double kGain = 6;

// Mirrors the index i of n values about the first and the last one.
int Mirrored(int i, int n) {
  while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
  return i;
}

// Spline coefficients of n samples in place: a causal and an anticausal recursion (Unser et al. 1993), for
// `lanes` interleaved signals at once.
void FilterInPlace(double* s, int n, int lanes) {
  constexpr int kHorizon = 30;  // |pole|^30 < 1e-17
  const auto at = [s, lanes](int i) { return s + static_cast<std::ptrdiff_t>(i) * lanes; };
  std::vector<double> first(static_cast<std::size_t>(lanes));
  double power = 1;
  for (int k = 0; k <= kHorizon; ++k, power *= kPole) {
    const double* sample = at(Mirrored(k, n));
    for (int l = 0; l < lanes; ++l) first[static_cast<std::size_t>(l)] += power * sample[l];
  }
  for (int l = 0; l < lanes; ++l) s[l] = first[static_cast<std::size_t>(l)];
  for (int i = 1; i < n; ++i) {
    for (int l = 0; l < lanes; ++l) at(i)[l] += kPole * at(i - 1)[l];
  }
  const double end = kPole / (kPole * kPole - 1);
  for (int l = 0; l < lanes; ++l) at(n - 1)[l] = end * (at(n - 1)[l] + kPole * at(n - 2)[l]);
  for (int i = n - 2; i >= 0; --i) {
    for (int l = 0; l < lanes; ++l) at(i)[l] = kPole * (at(i + 1)[l] - at(i)[l]);
  }
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(n) * lanes; ++i) s[i] *= kGain;
}

}  // namespace

CubicImage::CubicImage(const Image& image)
    : width_(image.width),
      height_(image.height),
      last_x_(image.width - 1),
      last_y_(image.height - 1),
      stride_(static_cast<std::size_t>(std::max(image.width, 0)) + 3) {
  if (width_ < 2 || height_ < 2) {
    throw InputError("an image of " + std::to_string(width_) + " x " + std::to_string(height_) +
                     " pixels has nothing between its pixels: at least 2 x 2 are needed");
  }
  row_coefficients_.resize(stride_ * static_cast<std::size_t>(height_));
  coefficients_.resize(stride_ * static_cast<std::size_t>(height_ + 3));
  const int columns = static_cast<int>(stride_);

  std::vector<double> row(static_cast<std::size_t>(width_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) row[static_cast<std::size_t>(x)] = image(x, y);
    FilterInPlace(row.data(), width_, 1);
    float* to = row_coefficients_.data() + static_cast<std::size_t>(y) * stride_;
    for (int i = 0; i < columns; ++i) {
      to[i] = static_cast<float>(row[static_cast<std::size_t>(Mirrored(i - 1, width_))]);
    }
  }

  constexpr int kStrip = 16;  // columns at a time: a cache line of rows
  std::vector<double> strip(static_cast<std::size_t>(height_) * kStrip);
  for (int first = 0; first < columns; first += kStrip) {
    const int lanes = std::min(kStrip, columns - first);
    for (int y = 0; y < height_; ++y) {
      for (int l = 0; l < lanes; ++l) {
        strip[static_cast<std::size_t>(y * lanes + l)] = RowCoefficients(y)[first + l];
      }
    }
    FilterInPlace(strip.data(), height_, lanes);
    for (int j = 0; j < height_ + 3; ++j) {
      const int y = Mirrored(j - 1, height_);
      for (int l = 0; l < lanes; ++l) {
        coefficients_[static_cast<std::size_t>(j) * stride_ + static_cast<std::size_t>(first + l)] =
            static_cast<float>(strip[static_cast<std::size_t>(y * lanes + l)]);
      }
    }
  }
}

CubicSample CubicImage::At(double x, double y) const {
  const double inside_x = x > 0 ? std::min(x, last_x_) : 0, inside_y = y > 0 ? std::min(y, last_y_) : 0;
  const int cell_x = std::min(static_cast<int>(inside_x), width_ - 2);
  const int cell_y = std::min(static_cast<int>(inside_y), height_ - 2);
  const CubicWeights wx(inside_x - cell_x), wy(inside_y - cell_y);
  CubicSample sample;
  for (int j = 0; j < 4; ++j) {
    const float* c = coefficients_.data() + static_cast<std::size_t>(cell_y + j) * stride_ + cell_x;
    double value = 0, dx = 0;
    for (int i = 0; i < 4; ++i) {
      value += wx.value[static_cast<std::size_t>(i)] * c[i];
      dx += wx.derivative[static_cast<std::size_t>(i)] * c[i];
    }
    sample.value += wy.value[static_cast<std::size_t>(j)] * value;
    sample.dx += wy.value[static_cast<std::size_t>(j)] * dx;
    sample.dy += wy.derivative[static_cast<std::size_t>(j)] * value;
  }
  return sample;
}

}  // namespace frond
