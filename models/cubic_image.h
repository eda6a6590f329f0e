// SPDX-License-Identifier: BSD-3-Clause
// An image between its pixels: the cubic B-spline that goes through every pixel (Unser, Aldroubi and Eden
// 1993), twice continuously differentiable, mirrored at the border pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "models/raster.h"

namespace frond {

struct CubicSample {
  double value = 0;
  double dx = 0, dy = 0;  // grey levels a pixel
};

// The four cubic B-splines that reach over [0, 1], at t in [0, 1], and their derivatives.
struct CubicWeights {
  std::array<double, 4> value;
  std::array<double, 4> derivative;

  explicit CubicWeights(double t) {
    const double s = 1 - t, t2 = t * t, s2 = s * s;
    value = {s2 * s / 6, 2.0 / 3 - t2 * (1 - t / 2), 2.0 / 3 - s2 * (1 - s / 2), t2 * t / 6};
    derivative = {-s2 / 2, t * (1.5 * t - 2), s * (2 - 1.5 * s), t2 / 2};
  }
};

// Positions outside of [0, width − 1] × [0, height − 1] have the value of the nearest border point.
class CubicImage {
 public:
  CubicImage() = default;

  // Throws InputError for an image of less than 2 × 2 pixels.
  explicit CubicImage(const Image& image);

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0; }

  // The spline in x and y.
  CubicSample At(double x, double y) const;

  // At an integer row y in [0, height) the spline of the image is the spline of that row: dy is not computed.
  // The same interpolant as At, at a quarter of its price.
  CubicSample AtRow(double x, int y) const {
    const double inside = x > 0 ? std::min(x, last_x_) : 0;  // of a NaN too
    const int cell = std::min(static_cast<int>(inside), width_ - 2);
    const CubicWeights w(inside - cell);
    const float* c = RowCoefficients(y) + cell;
    return {.value = w.value[0] * c[0] + w.value[1] * c[1] + w.value[2] * c[2] + w.value[3] * c[3],
            .dx = w.derivative[0] * c[0] + w.derivative[1] * c[1] + w.derivative[2] * c[2] +
                  w.derivative[3] * c[3]};
  }

  // The same for a ceres::Jet x (any type with a value .a and a derivative .v), by the chain rule.
  template <typename Jet>
  requires requires(Jet x) { x.v; }
  Jet ValueAtRow(const Jet& x, int y) const {
    const CubicSample sample = AtRow(x.a, y);
    return Jet(sample.value, sample.dx * x.v);
  }
  double ValueAtRow(double x, int y) const { return AtRow(x, y).value; }

  template <typename Jet>
  requires requires(Jet x) { x.v; }
  Jet ValueAt(const Jet& x, const Jet& y) const {
    const CubicSample sample = At(x.a, y.a);
    return Jet(sample.value, sample.dx * x.v + sample.dy * y.v);
  }
  double ValueAt(double x, double y) const { return At(x, y).value; }

  // The coefficients of the spline of row y, for the columns −1 … width + 1: those of cell [i, i + 1] are
  // [i] … [i + 3].
  const float* RowCoefficients(int y) const {
    return row_coefficients_.data() + static_cast<std::size_t>(y) * stride_;
  }

 private:
  int width_ = 0, height_ = 0;
  double last_x_ = 0, last_y_ = 0;
  std::size_t stride_ = 0;
  std::vector<float> row_coefficients_;  // height × stride: filtered in x alone
  std::vector<float> coefficients_;      // (height + 3) × stride: filtered in x and y
};

}  // namespace frond
