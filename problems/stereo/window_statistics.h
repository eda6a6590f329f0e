// SPDX-License-Identifier: BSD-3-Clause
// What a solved window says of itself: correlation, noise, and how far the noise can have moved the
// disparity.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>

#include "problems/stereo/interpolation_noise.h"
#include "problems/stereo/window_system.h"

namespace frond {

// How far white noise of unit variance in both images moves the disparity, and what it leaves in the
// residuals.
struct NoiseResponse {
  double disparity = 0;  // variance
  double residuals = 0;  // expected sum of squares
};

// Expected Σ n n″ φφᵀ, φ = ∂u/∂warp: what noise of unit variance takes off the curvature of the cost that
// Gauss–Newton's matrix has. 0 for the affine warp.
template <WarpKind kWarp, RadiometryKind kRadiometry>
auto NoiseCurvature(const WindowPatch& patch, const WindowSamples& samples, const InterpolationNoise& noise) {
  using System = WindowSystem<kWarp, kRadiometry>;
  Eigen::Matrix<double, System::kP, System::kP> curvature;
  curvature.setZero();
  if constexpr (StaysInRow(kWarp)) {
    for (int row = 0; row < patch.size; ++row) {
      for (int k = 0; k < patch.size; ++k) {
        const int i = row * patch.stride + k;
        const auto phi = System::SlopeRow(patch.weight[i], 0, k - patch.half, row - patch.half);
        curvature.noalias() += noise.At(samples.fraction[i]).with_curvature * phi * phi.transpose();
      }
    }
  }
  return curvature;
}

// The influence of each residual on the warp's first value, with `a` the row of H⁻¹ of that value, gives its
// variance: through the interpolation on the pixels of the right image, through the gain on those of the
// left.
template <WarpKind kWarp, RadiometryKind kRadiometry, int kP, int kQ>
NoiseResponse ResponseToNoise(const WindowPatch& patch, const WindowSamples& samples,
                              const RadiometryValues& radiometry, const ReducedSystem<kP, kQ>& reduced,
                              const Eigen::Matrix<double, kP, 1>& a, const InterpolationNoise& noise) {
  using System = WindowSystem<kWarp, kRadiometry>;
  Eigen::Matrix<double, kQ, 1> b;
  if constexpr (kQ > 0) b = reduced.X * a;
  std::array<double, WindowPatch::kMaxPixels> influence;
  double squares = 0, left = 0, right = 0, residuals = 0;
  for (int row = 0; row < patch.size; ++row) {
    const int begin = row * patch.stride;
    for (int k = 0; k < patch.size; ++k) {
      const int i = begin + k;
      const double xi = k - patch.half, eta = row - patch.half;
      double h = a.dot(System::SlopeRow(samples.slope[i], samples.slope_y[i], xi, eta)), gain = 1;
      if constexpr (kQ > 0) {
        h -= b.dot(System::RadiometryRow(patch.level[i], patch.weight[i], xi, eta));
        gain = ApplyRadiometry<kRadiometry>(radiometry.data(), 1.0, xi, eta) - radiometry[1];
      }
      influence[static_cast<std::size_t>(i)] = h;
      squares += h * h;
      left += gain * gain * h * h;
      residuals +=
          patch.weight[i] * (gain * gain * noise.pixel_variance() + noise.At(samples.fraction[i]).variance);
    }
    if (StaysInRow(kWarp) && !noise.smooths()) {
      right += InterpolationNoise::InterpolatedEnergy(influence.data() + begin, samples.cell + begin,
                                                      samples.fraction + begin, patch.size);
    }
  }
  if (noise.smooths() || !StaysInRow(kWarp)) {
    // Smoothed noise comes through the interpolation as it is.
    right = noise.SmoothedEnergy(influence.data(), patch.size, patch.stride);
    left *= right / squares;
  }
  // Each of the kP + kQ parameters takes the noise of one direction off the residuals, taken as the
  // disparity's.
  const double taken = (left + right) / squares;
  return {.disparity = left + right, .residuals = residuals - (kP + kQ) * taken};
}

// Of the right image's window with the left one under the radiometry.
template <RadiometryKind kRadiometry>
double Correlation(const WindowPatch& patch, const WindowSamples& samples, const WindowMatch& match) {
  double n = 0, r = 0, rr = 0, m = 0, mm = 0, rm = 0;
  for (int row = 0; row < patch.size; ++row) {
    for (int k = 0; k < patch.size; ++k) {
      const int i = row * patch.stride + k;
      const double level = patch.level[i], weight = patch.weight[i];
      const double model = weight * ApplyRadiometry<kRadiometry>(match.radiometry.data(), level,
                                                                 k - patch.half, row - patch.half);
      const double value = samples.value[i] + (kRadiometry == RadiometryKind::kNone ? level : 0);
      n += weight;
      r += value;
      rr += value * value;
      m += model;
      mm += model * model;
      rm += value * model;
    }
  }
  const double product = (rr - r * r / n) * (mm - m * m / n);
  if (!(product > 0)) return 0;
  const double sign = kRadiometry == RadiometryKind::kNone || match.radiometry[0] >= 0 ? 1 : -1;
  return sign * (rm - r * m / n) / std::sqrt(product);
}

// Fills noise, correlation and sigma of a match whose warp and radiometry are those of `reduced`.
template <WarpKind kWarp, RadiometryKind kRadiometry, int kP, int kQ>
void Describe(const WindowPatch& patch, const WindowSamples& samples, const ReducedSystem<kP, kQ>& reduced,
              const InterpolationNoise& noise, WindowMatch* match) {
  using Matrix = Eigen::Matrix<double, kP, kP>;
  using Vector = Eigen::Matrix<double, kP, 1>;
  match->pixels = patch.pixels;
  match->noise = std::sqrt(reduced.f / patch.pixels);
  match->correlation = Correlation<kRadiometry>(patch, samples, *match);

  // The noise's variance as the residuals show it, by Gauss–Newton's matrix and then by the corrected one.
  Vector a = Eigen::LLT<Matrix>(reduced.H).solve(Vector::Unit(0));
  NoiseResponse response =
      ResponseToNoise<kWarp, kRadiometry>(patch, samples, match->radiometry, reduced, a, noise);
  if (!(response.residuals > 0)) return;
  const double variance = reduced.f / response.residuals;
  const Matrix H = reduced.H + variance * NoiseCurvature<kWarp, kRadiometry>(patch, samples, noise);
  const Eigen::LLT<Matrix> factor(H);
  if (factor.info() != Eigen::Success) return;
  a = factor.solve(Vector::Unit(0));
  response = ResponseToNoise<kWarp, kRadiometry>(patch, samples, match->radiometry, reduced, a, noise);
  match->sigma = std::sqrt(variance * response.disparity);
}

}  // namespace frond
