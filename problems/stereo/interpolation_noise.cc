// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/interpolation_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace frond {
namespace {

const double kPole = std::sqrt(3.0) - 2;

// The autocorrelation of the filter from pixels to spline coefficients, √3 pole^|m|, at a lag of k.
double FilterCorrelation(int k) {
  const double squared = kPole * kPole;
  return 3 * std::pow(kPole, std::abs(k)) * (std::abs(k) + (1 + squared) / (1 - squared));
}

std::array<InterpolationNoise, InterpolationNoise::kBins + 1> Tabulated() {
  std::array<InterpolationNoise, InterpolationNoise::kBins + 1> table;
  for (std::size_t bin = 0; bin < table.size(); ++bin) {
    const double t = static_cast<double>(bin) / InterpolationNoise::kBins;
    const CubicWeights w(t);
    const std::array<double, 4> curvature = {1 - t, 3 * t - 2, 1 - 3 * t, t};
    InterpolationNoise& noise = table[bin];
    noise = {.variance = 0, .with_slope = 0, .with_curvature = 0};
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const double value = w.value[static_cast<std::size_t>(i)] * FilterCorrelation(i - j);
        noise.variance += value * w.value[static_cast<std::size_t>(j)];
        noise.with_slope += value * w.derivative[static_cast<std::size_t>(j)];
        noise.with_curvature += value * curvature[static_cast<std::size_t>(j)];
      }
    }
  }
  return table;
}

}  // namespace

const InterpolationNoise& InterpolationNoise::At(double t) {
  static const std::array<InterpolationNoise, kBins + 1> table = Tabulated();
  return table[static_cast<std::size_t>(t * kBins + 0.5)];
}

double InterpolatedEnergy(const double* influence, const int* cell, const double* fraction, int count) {
  constexpr int kMargin = 10;  // |pole|^10 is 2e-6
  constexpr int kCapacity = 512;
  const auto [first, last] = std::minmax_element(cell, cell + count);
  const int length = *last - *first + 4 + 2 * kMargin;
  std::array<double, kCapacity> row;
  if (length > kCapacity) {  // stretched beyond all matching
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += influence[i] * influence[i];
    return sum;
  }
  std::fill(row.begin(), row.begin() + length, 0.0);
  for (int i = 0; i < count; ++i) {
    const CubicWeights w(fraction[i]);
    double* to = row.data() + (cell[i] - *first + kMargin);
    for (std::size_t k = 0; k < 4; ++k) to[k] += influence[i] * w.value[k];
  }
  // The symmetric filter √3 pole^|m| by the recursions of CubicImage, whose gain 6 is squared at the end.
  for (int i = 1; i < length; ++i)
    row[static_cast<std::size_t>(i)] += kPole * row[static_cast<std::size_t>(i - 1)];
  double next = kPole / (kPole * kPole - 1) * row[static_cast<std::size_t>(length - 1)];
  double sum = next * next;
  for (int i = length - 2; i >= 0; --i) {
    next = kPole * (next - row[static_cast<std::size_t>(i)]);
    sum += next * next;
  }
  return 36 * sum;
}

}  // namespace frond
