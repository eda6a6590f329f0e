// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "models/raster.h"

namespace frond {

constexpr double kLargestSmoothing = 5;  // px

// Samples of a Gaussian of standard deviation `sigma` (pixels, 0 to kLargestSmoothing) out to 3 of them,
// their sum 1; of 0 the one value 1.
std::vector<double> GaussianKernel(double sigma);

// The image smoothed with GaussianKernel in x and y. Pixels outside of `mask` (empty: all are inside) or of
// the image have no part in it, and keep their values.
Image Smoothed(const Image& image, const Mask& mask, double sigma);

}  // namespace frond
