// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/interpolation_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "models/smoothing.h"

namespace frond {
namespace {

// From pixels to spline coefficients: the filter √3 pole^|m|.
const double kPole = std::sqrt(3.0) - 2;
constexpr int kFilterReach = 14;  // |pole|^14 is 1e-8

// The kernel of smoothing followed by that filter.
std::vector<double> SmoothedFilter(const std::vector<double>& kernel) {
  std::vector<double> filter(kernel.size() + 2 * kFilterReach, 0.0);
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    for (int m = -kFilterReach; m <= kFilterReach; ++m) {
      filter[i + static_cast<std::size_t>(m + kFilterReach)] +=
          kernel[i] * std::sqrt(3.0) * std::pow(kPole, std::abs(m));
    }
  }
  return filter;
}

double Autocorrelation(const std::vector<double>& filter, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = lag; i < filter.size(); ++i) sum += filter[i] * filter[i - lag];
  return sum;
}

double Squares(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

}  // namespace

InterpolationNoise::InterpolationNoise(double smoothing) : kernel_(GaussianKernel(smoothing)) {
  const double across = Squares(kernel_);
  pixel_variance_ = across * across;
  const std::vector<double> filter = SmoothedFilter(kernel_);
  std::array<double, 4> correlation;
  for (std::size_t lag = 0; lag < 4; ++lag) correlation[lag] = across * Autocorrelation(filter, lag);
  for (std::size_t bin = 0; bin < table_.size(); ++bin) {
    const double t = static_cast<double>(bin) / kBins;
    const CubicWeights w(t);
    const std::array<double, 4> curvature = {1 - t, 3 * t - 2, 1 - 3 * t, t};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const double value = w.value[i] * correlation[i > j ? i - j : j - i];
        table_[bin].variance += value * w.value[j];
        table_[bin].with_curvature += value * curvature[j];
      }
    }
  }
}

double InterpolationNoise::SmoothedEnergy(const double* influence, int size, int stride) const {
  constexpr int kCapacity = kMaxWindowSize + 2 * static_cast<int>(3 * kLargestSmoothing);
  const int reach = static_cast<int>(kernel_.size()) / 2;
  std::array<double, kMaxWindowSize> column_sums;
  std::array<double, kCapacity> smoothed;
  double energy = 0;
  for (int row = -reach; row < size + reach; ++row) {
    std::fill_n(column_sums.begin(), size, 0.0);
    for (int j = std::max(0, row - reach); j <= std::min(size - 1, row + reach); ++j) {
      const double share = kernel_[static_cast<std::size_t>(j - row + reach)];
      for (int i = 0; i < size; ++i)
        column_sums[static_cast<std::size_t>(i)] += share * influence[j * stride + i];
    }
    const auto length = static_cast<std::size_t>(size + 2 * reach);
    std::fill_n(smoothed.begin(), length, 0.0);
    for (std::size_t k = 0; k < kernel_.size(); ++k) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
        smoothed[i + k] += kernel_[k] * column_sums[i];
      }
    }
    energy += Squares({smoothed.data(), length});
  }
  return energy;
}

double InterpolationNoise::InterpolatedEnergy(const double* influence, const int* cell,
                                              const double* fraction, int count) {
  constexpr int kMargin = 10;  // |pole|^10 is 2e-6
  constexpr int kCapacity = 512;
  const auto [first, last] = std::minmax_element(cell, cell + count);
  const int length = *last - *first + 4 + 2 * kMargin;
  std::array<double, kCapacity> row;
  if (length > kCapacity)
    return Squares({influence, static_cast<std::size_t>(count)});  // beyond all matching
  std::fill(row.begin(), row.begin() + length, 0.0);
  for (int i = 0; i < count; ++i) {
    const CubicWeights w(fraction[i]);
    double* to = row.data() + (cell[i] - *first + kMargin);
    for (std::size_t k = 0; k < 4; ++k) to[k] += influence[i] * w.value[k];
  }
  // The symmetric filter by the recursions of CubicImage, whose gain 6 is squared at the end.
  for (int i = 1; i < length; ++i) {
    row[static_cast<std::size_t>(i)] += kPole * row[static_cast<std::size_t>(i - 1)];
  }
  double next = kPole / (kPole * kPole - 1) * row[static_cast<std::size_t>(length - 1)];
  double sum = next * next;
  for (int i = length - 2; i >= 0; --i) {
    next = kPole * (next - row[static_cast<std::size_t>(i)]);
    sum += next * next;
  }
  return 36 * sum;
}

}  // namespace frond
