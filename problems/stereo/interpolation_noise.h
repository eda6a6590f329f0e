// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "problems/stereo/window_model.h"

namespace frond {

// White noise n of unit variance in the pixels, smoothed with the images and seen through the cubic spline at
// the fraction t between two pixels.
class InterpolationNoise {
 public:
  struct Moments {
    double variance = 0;        // E[n(t)²]: unsmoothed 1 at a pixel, 0.73 half-way
    double with_curvature = 0;  // E[n(t) n″(t)]
  };

  // `smoothing`: WindowModel's.
  explicit InterpolationNoise(double smoothing);

  // At the nearest tabulated fraction, t in [0, 1].
  const Moments& At(double t) const { return table_[static_cast<std::size_t>(t * kBins + 0.5)]; }
  double pixel_variance() const { return pixel_variance_; }  // of the smoothed noise at a pixel

  // The variance of Σ h_i n_i over a window's pixels, h of size × size values, rows `stride` apart: smoothed,
  // with neighbours that vary together.
  double SmoothedEnergy(const double* influence, int size, int stride) const;
  bool smooths() const { return kernel_.size() > 1; }

  // The same for one row of unsmoothed samples in the cells [c, c + 1] of the right image at fractions t.
  static double InterpolatedEnergy(const double* influence, const int* cell, const double* fraction,
                                   int count);

 private:
  static constexpr int kBins = 64;
  std::array<Moments, kBins + 1> table_;
  std::vector<double> kernel_;  // of the smoothing, symmetric, its sum 1
  double pixel_variance_ = 1;
};

}  // namespace frond
