// SPDX-License-Identifier: BSD-3-Clause
// What a solved window says of itself: correlation, noise, and how far the noise can have moved the
// disparity.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>

#include "problems/stereo/interpolation_noise.h"
#include "problems/stereo/window_system.h"

namespace frond {

// How noise of unit variance in both images acts on a window: n_R by the interpolation, n_L by the gain.
template <WarpKind kWarp, RadiometryKind kRadiometry>
struct WindowNoise {
  using System = WindowSystem<kWarp, kRadiometry>;
  static constexpr int kP = System::kP, kQ = System::kQ;

  double residual_variance = 0;  // the mean, of a pixel's residual
  // E[Σ n n″ φφᵀ] and E[Σ n n′ φ], φ = ∂(u, v)/∂warp: the curvature that Gauss–Newton's matrix has too much,
  // and the pull of the smoother half-way positions.
  Eigen::Matrix<double, kP, kP> curvature = Eigen::Matrix<double, kP, kP>::Zero();
  Eigen::Matrix<double, kP, 1> pull = Eigen::Matrix<double, kP, 1>::Zero();

  WindowNoise(const WindowPatch& patch, const WindowSamples& samples, const RadiometryValues& radiometry) {
    double sum = 0;
    for (int row = 0; row < patch.size; ++row) {
      for (int k = 0; k < patch.size; ++k) {
        const int i = row * patch.stride + k;
        if (patch.weight[i] == 0) continue;
        const double xi = k - patch.half, eta = row - patch.half;
        const InterpolationNoise& noise = InterpolationNoise::At(samples.fraction[i]);
        const double gain =
            ApplyRadiometry<kRadiometry>(radiometry.data(), 1.0, xi, eta) - (kQ == 0 ? 0 : radiometry[1]);
        sum += gain * gain + noise.variance;
        if constexpr (StaysInRow(kWarp)) {
          const auto phi = System::SlopeRow(1, 0, xi, eta);
          curvature.noalias() += noise.with_curvature * phi * phi.transpose();
          pull.noalias() += noise.with_slope * phi;
        }
      }
    }
    residual_variance = sum / patch.pixels;
  }
};

// Variance of the disparity for noise of unit variance: the influence of each residual on the warp's first
// value, through the interpolation on the pixels of the right image and through the gain on those of the left
// one. `a`: the row of H⁻¹ of that value.
template <WarpKind kWarp, RadiometryKind kRadiometry, int kP, int kQ>
double UnitVariance(const WindowPatch& patch, const WindowSamples& samples,
                    const RadiometryValues& radiometry, const ReducedSystem<kP, kQ>& reduced,
                    const Eigen::Matrix<double, kP, 1>& a) {
  using System = WindowSystem<kWarp, kRadiometry>;
  Eigen::Matrix<double, kQ, 1> b;
  if constexpr (kQ > 0) b = reduced.X * a;
  std::array<double, kMaxWindowSize> influence;
  double variance = 0;
  for (int row = 0; row < patch.size; ++row) {
    double own = 0;
    for (int k = 0; k < patch.size; ++k) {
      const int i = row * patch.stride + k;
      const double xi = k - patch.half, eta = row - patch.half;
      double h = a.dot(System::SlopeRow(samples.slope[i], samples.slope_y[i], xi, eta));
      double gain = 1;
      if constexpr (kQ > 0) {
        h -= b.dot(System::RadiometryRow(patch.level[i], patch.weight[i], xi, eta));
        gain = ApplyRadiometry<kRadiometry>(radiometry.data(), 1.0, xi, eta) - radiometry[1];
      }
      influence[static_cast<std::size_t>(k)] = h;
      own += h * h;
      variance += gain * gain * h * h;
    }
    if constexpr (StaysInRow(kWarp)) {
      const int begin = row * patch.stride;
      variance +=
          InterpolatedEnergy(influence.data(), samples.cell + begin, samples.fraction + begin, patch.size);
    } else {
      variance += own;
    }
  }
  return variance;
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
              WindowMatch* match) {
  const int n = patch.pixels;
  match->pixels = n;
  match->noise = std::sqrt(reduced.f / n);
  match->correlation = Correlation<kRadiometry>(patch, samples, *match);

  const int redundant = n - kP - kQ;
  if (redundant <= 0) return;
  const WindowNoise<kWarp, kRadiometry> noise(patch, samples, match->radiometry);
  const double variance = reduced.f / redundant / noise.residual_variance;
  Eigen::Matrix<double, kP, kP> H = reduced.H + variance * noise.curvature;
  const Eigen::LLT<Eigen::Matrix<double, kP, kP>> factor(H);
  if (factor.info() != Eigen::Success) return;
  const Eigen::Matrix<double, kP, 1> a = factor.solve(Eigen::Matrix<double, kP, 1>::Unit(0));
  match->sigma =
      std::sqrt(variance * UnitVariance<kWarp, kRadiometry>(patch, samples, match->radiometry, reduced, a));
  match->pull = variance * a.dot(noise.pull);
}

}  // namespace frond
