// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "models/cubic_image.h"

namespace frond {

// What the cubic spline through white noise n of unit variance makes of it at the fraction t between two
// pixels. Between pixels the noise is smoothed (0.73 of its variance at t = ½), which pulls least-squares
// shifts towards the middle, and its slope adds to the slopes of the texture.
struct InterpolationNoise {
  double variance = 1;        // E[n(t)²]
  double with_slope = 0;      // E[n(t) n′(t)], half the variance's derivative
  double with_curvature = 0;  // E[n(t) n″(t)]

  // The nearest of kBins tabulated fractions, t in [0, 1].
  static constexpr int kBins = 256;
  static const InterpolationNoise& At(double t);
};

// A row of influences h_i on samples at fractional positions, brought to the pixels that those are
// interpolated from: Σ (Wᵀh)², W the weights of the interpolation. The noise of a sum Σ h_i n(x_i) is this
// times the noise's variance. `count` samples, each in a cell [c, c + 1] of the row.
double InterpolatedEnergy(const double* influence, const int* cell, const double* fraction, int count);

}  // namespace frond
