// SPDX-License-Identifier: BSD-3-Clause
#include "models/smoothing.h"

#include <cmath>

namespace frond {
namespace {

// Σ k value and Σ k over the pixels inside, along x (dx = 1) or y.
void Convolve(const std::vector<double>& kernel, int dx, const Image& from, const Image& weight, Image* to,
              Image* to_weight) {
  const int reach = static_cast<int>(kernel.size()) / 2, dy = 1 - dx;
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      double sum = 0, total = 0;
      for (int k = -reach; k <= reach; ++k) {
        const int i = x + k * dx, j = y + k * dy;
        if (!from.Contains(i, j)) continue;
        const double share = kernel[static_cast<std::size_t>(k + reach)] * static_cast<double>(weight(i, j));
        sum += kernel[static_cast<std::size_t>(k + reach)] * static_cast<double>(from(i, j));
        total += share;
      }
      (*to)(x, y) = static_cast<float>(sum);
      (*to_weight)(x, y) = static_cast<float>(total);
    }
  }
}

}  // namespace

std::vector<double> GaussianKernel(double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> kernel;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(sigma > 0 ? std::exp(-0.5 * (k / sigma) * (k / sigma)) : 1.0);
    sum += kernel.back();
  }
  for (double& value : kernel) value /= sum;
  return kernel;
}

Image Smoothed(const Image& image, const Mask& mask, double sigma) {
  if (!(sigma > 0)) return image;
  const std::vector<double> kernel = GaussianKernel(sigma);
  Image inside = image, weight(image.width, image.height, 1), row(image.width, image.height), result = row;
  Image row_weight = row, total = row;
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    if (mask.values[i] == 0) inside.values[i] = weight.values[i] = 0;
  }
  Convolve(kernel, 1, inside, weight, &row, &row_weight);
  Convolve(kernel, 0, row, row_weight, &result, &total);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = weight.values[i] > 0 ? result.values[i] / total.values[i] : image.values[i];
  }
  return result;
}

}  // namespace frond
