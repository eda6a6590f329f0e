// SPDX-License-Identifier: BSD-3-Clause
// The normal equations of a window. With the rows R (the right image at the warp), S = −∂R/∂warp and B
// (radiometry = B c, linear in c) the linearised cost is ½ |R − S Δ − B c|²: BᵀB is the same for all warps of
// a window, c is eliminated, and nothing depends on a start of c.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "models/radiometry.h"
#include "models/window_warp.h"
#include "problems/stereo/window_patch.h"

namespace frond {

// R, its slopes and where it was sampled, laid out as the WindowPatch; 0 where a pixel does not take part.
struct WindowSamples {
  alignas(32) double value[WindowPatch::kMaxPixels];      // R; without radiometry R − L
  alignas(32) double slope[WindowPatch::kMaxPixels];      // ∂R/∂x
  alignas(32) double slope_y[WindowPatch::kMaxPixels];    // ∂R/∂y, of the affine warp
  alignas(32) double curvature[WindowPatch::kMaxPixels];  // ∂²R/∂x², of warps within the row
  double fraction[WindowPatch::kMaxPixels];               // x's, in its cell
  int cell[WindowPatch::kMaxPixels];
};

// What is left when c is eliminated: minimise ½ (f − 2 sᵀΔ + ΔᵀHΔ), c = y − X Δ. `curvature` is what Newton's
// matrix has beyond Gauss–Newton's H, Σ r ∂²R/∂warp² with the residuals r at a given c.
template <int kP, int kQ>
struct ReducedSystem {
  Eigen::Matrix<double, kP, kP> H;
  Eigen::Matrix<double, kP, kP> curvature;
  Eigen::Matrix<double, kP, 1> s;
  double f = 0;         // squared residuals, at the best c
  double rounding = 0;  // f is known up to this
  Eigen::Matrix<double, kQ, 1> y;
  Eigen::Matrix<double, kQ, kP> X;
};

template <WarpKind kWarp, RadiometryKind kRadiometry>
class WindowSystem {
 public:
  static constexpr int kP = WarpSize(kWarp), kQ = RadiometrySize(kRadiometry);
  // Degrees in ξ of the disparity and of the gain.
  static constexpr int kD = kWarp == WarpKind::kShift ? 0 : kWarp == WarpKind::kQuadratic ? 2 : 1;
  static constexpr int kE = kRadiometry == RadiometryKind::kPlanarGain ? 1 : 0;
  using Reduced = ReducedSystem<kP, kQ>;

  // False where the left window is too flat for its radiometry.
  bool SetPatch(const WindowPatch* patch) {
    patch_ = patch;
    if constexpr (kQ > 0) {
      BB_.setZero();
      for (int row = 0; row < patch->size; ++row) AddLevels(row);
      factor_.compute(BB_);
      if (factor_.info() != Eigen::Success) return false;
      const auto& L = factor_.matrixLLT();
      for (int i = 0; i < kQ; ++i) {
        if (!(L(i, i) * L(i, i) > kSmallestPivot * BB_(i, i))) return false;
      }
    }
    return true;
  }

  // Samples R at the warp and eliminates c. `radiometry`: about the best c there, for `curvature`; null:
  // leaves that zero, as it is for the affine warp.
  void Evaluate(const CubicImage& right, const double* warp, const double* radiometry, WindowSamples* samples,
                Reduced* reduced) {
    Sums sums;
    radiometry_ = radiometry;
    for (int row = 0; row < patch_->size; ++row) {
      Sample(right, warp, row, samples);
      if constexpr (StaysInRow(kWarp)) {
        AddRow(row, *samples, &sums);
      } else {
        AddPixels(row, *samples, &sums);
      }
    }
    Eliminate(sums, reduced);
  }

  // Row i of S, or of S for the vertical shifts alone where the warp has them.
  static Eigen::Matrix<double, kP, 1> SlopeRow(double slope, double slope_y, double xi, double eta) {
    Eigen::Matrix<double, kP, 1> s;
    if constexpr (kWarp == WarpKind::kAffine) {
      s << slope, slope * xi, slope * eta, slope_y, slope_y * xi, slope_y * eta;
    } else {
      for (int j = 0; j < kP; ++j) s[j] = slope * Power(xi, kXi[j]) * Power(eta, kEta[j]);
    }
    return s;
  }

  static Eigen::Matrix<double, kQ, 1> RadiometryRow(double level, double weight, double xi, double eta) {
    Eigen::Matrix<double, kQ, 1> b;
    if constexpr (kRadiometry == RadiometryKind::kGainOffset) b << level, weight;
    if constexpr (kRadiometry == RadiometryKind::kPlanarGain) b << level, weight, xi * level, eta * level;
    return b;
  }

 private:
  static constexpr double kRounding = 1e-14;       // of Σ R², which f is a small difference to
  static constexpr double kSmallestPivot = 1e-10;  // relative: a contrast of 1e-5 of the level
  static constexpr int kXi[] = {0, 1, 0, 2, 1, 0},
                       kEta[] = {0, 0, 1, 0, 1, 2};  // powers of the disparity's terms
  using Lane = Eigen::Array2d;                       // neighbouring pixels, as one SSE2 register

  struct Sums {
    Eigen::Matrix<double, kP, kP> SS = Eigen::Matrix<double, kP, kP>::Zero();  // upper triangle
    Eigen::Matrix<double, kQ, kP> BS = Eigen::Matrix<double, kQ, kP>::Zero();
    Eigen::Matrix<double, kP, 1> SR = Eigen::Matrix<double, kP, 1>::Zero();
    Eigen::Matrix<double, kQ, 1> BR = Eigen::Matrix<double, kQ, 1>::Zero();
    Eigen::Matrix<double, kP, kP> curvature = Eigen::Matrix<double, kP, kP>::Zero();  // upper triangle
    double RR = 0;
  };

  static constexpr double Power(double x, int n) { return n == 0 ? 1 : n == 1 ? x : x * x; }

  void Sample(const CubicImage& right, const double* warp, int row, WindowSamples* samples) const {
    const double eta = row - patch_->half;
    const int begin = row * patch_->stride;
    // Rows beyond the image take no part, but are sampled: from within.
    const int y = std::clamp(patch_->y + row - patch_->half, 0, right.height() - 1);
    for (int k = 0; k < patch_->stride; ++k) {
      const int i = begin + k;
      const double xi = k - patch_->half, weight = patch_->weight[i];
      const double x = patch_->x + xi - WarpDisparity<kWarp>(warp, xi, eta);
      double value;
      if constexpr (StaysInRow(kWarp)) {
        const double inside = x > 0 ? std::min(x, right.width() - 1.0) : 0;
        const int cell = std::min(static_cast<int>(inside), right.width() - 2);
        const double t = inside - cell;
        const CubicWeights w(t);
        const float* c = right.RowCoefficients(y) + cell;
        value = w.value[0] * c[0] + w.value[1] * c[1] + w.value[2] * c[2] + w.value[3] * c[3];
        samples->slope[i] = weight * (w.derivative[0] * c[0] + w.derivative[1] * c[1] +
                                      w.derivative[2] * c[2] + w.derivative[3] * c[3]);
        samples->curvature[i] =
            weight * ((c[0] - 2.0 * c[1] + c[2]) * (1 - t) + (c[1] - 2.0 * c[2] + c[3]) * t);
        samples->fraction[i] = t;
        samples->cell[i] = cell;
      } else {
        const double right_y = y - WarpVerticalShift(warp, xi, eta);
        const CubicSample sample = right.At(x, right_y);
        value = sample.value;
        samples->slope[i] = weight * sample.dx;
        samples->slope_y[i] = weight * sample.dy;
        samples->fraction[i] = x - std::floor(x);
      }
      samples->value[i] = weight * value - (kQ == 0 ? patch_->level[i] : 0);
    }
  }

  void AddLevels(int row) {
    const double eta = row - patch_->half;
    const int begin = row * patch_->stride;
    double n = 0, l[2] = {}, ll[3] = {};
    for (int k = 0; k < patch_->stride; ++k) {
      const double xi = k - patch_->half, level = patch_->level[begin + k];
      n += patch_->weight[begin + k];
      l[0] += level;
      l[1] += level * xi;
      ll[0] += level * level;
      ll[1] += level * level * xi;
      ll[2] += level * level * xi * xi;
    }
    if constexpr (kQ >= 2) {
      BB_(0, 0) += ll[0];
      BB_(1, 0) += l[0];
      BB_(1, 1) += n;
    }
    if constexpr (kQ == 4) {
      BB_(2, 0) += ll[1];
      BB_(2, 1) += l[1];
      BB_(2, 2) += ll[2];
      BB_(3, 0) += ll[0] * eta;
      BB_(3, 1) += l[0] * eta;
      BB_(3, 2) += ll[1] * eta;
      BB_(3, 3) += ll[0] * eta * eta;
    }
  }

  // In a row η is constant and all products are of powers of ξ with 6 sums, g the slope, q the residual times
  // ∂²R/∂x²; even pixels and odd ones apart.
  struct RowSums {
    Lane gg[2 * kD + 1], gr[kD + 1], gl[kD + kE + 1], g1[kD + 1], rl[kE + 1], q[2 * kD + 1], r1, rr;

    RowSums() {
      for (Lane& lane : gg) lane.setZero();
      for (Lane& lane : gr) lane.setZero();
      for (Lane& lane : gl) lane.setZero();
      for (Lane& lane : g1) lane.setZero();
      for (Lane& lane : rl) lane.setZero();
      for (Lane& lane : q) lane.setZero();
      r1.setZero();
      rr.setZero();
    }
  };

  // Residual = r − offset − (gain + gain_slope ξ) l.
  struct RowRadiometry {
    double gain = 0, offset = 0, gain_slope = 0;
  };

  RowRadiometry RadiometryOfRow(double eta) const {
    RowRadiometry row;
    if constexpr (kQ > 0) {
      if (radiometry_ != nullptr) {
        row = {.gain = radiometry_[0] + (kE > 0 ? radiometry_[3] * eta : 0),
               .offset = radiometry_[1],
               .gain_slope = kE > 0 ? radiometry_[2] : 0};
      }
    }
    return row;
  }

  void AddRow(int row, const WindowSamples& samples, Sums* sums) const {
    const int begin = row * patch_->stride;
    const double eta = row - patch_->half;
    const bool with_curvature = radiometry_ != nullptr;
    const RowRadiometry radiometry = RadiometryOfRow(eta);
    RowSums of_row;
    Lane xi(-patch_->half, 1 - patch_->half);
    for (int i = begin; i < begin + patch_->stride; i += 2, xi += 2) {
      const Lane g = Eigen::Map<const Lane, Eigen::Aligned16>(samples.slope + i);
      const Lane r = Eigen::Map<const Lane, Eigen::Aligned16>(samples.value + i);
      AddPowers(g * g, xi, of_row.gg);
      AddPowers(g * r, xi, of_row.gr);
      of_row.rr += r * r;
      Lane residual = r;
      if constexpr (kQ > 0) {
        const Lane l = Eigen::Map<const Lane, Eigen::Aligned16>(patch_->level + i);
        AddPowers(g * l, xi, of_row.gl);
        AddPowers(g, xi, of_row.g1);
        AddPowers(r * l, xi, of_row.rl);
        of_row.r1 += r;
        residual -= radiometry.offset + (radiometry.gain + radiometry.gain_slope * xi) * l;
      }
      if (with_curvature) {
        AddPowers(Eigen::Map<const Lane, Eigen::Aligned16>(samples.curvature + i) * residual, xi, of_row.q);
      }
    }
    AddRowSums(of_row, eta, sums);
  }

  static void AddRowSums(const RowSums& row, double eta, Sums* sums) {
    for (int j = 0; j < kP; ++j) {
      for (int i = 0; i <= j; ++i) {
        const double power = Power(eta, kEta[i]) * Power(eta, kEta[j]);
        sums->SS(i, j) += row.gg[kXi[i] + kXi[j]].sum() * power;
        sums->curvature(i, j) += row.q[kXi[i] + kXi[j]].sum() * power;
      }
      const double power = Power(eta, kEta[j]);
      sums->SR[j] += row.gr[kXi[j]].sum() * power;
      if constexpr (kQ >= 2) {
        sums->BS(0, j) += row.gl[kXi[j]].sum() * power;
        sums->BS(1, j) += row.g1[kXi[j]].sum() * power;
      }
      if constexpr (kQ == 4) {
        sums->BS(2, j) += row.gl[kXi[j] + 1].sum() * power;
        sums->BS(3, j) += row.gl[kXi[j]].sum() * power * eta;
      }
    }
    if constexpr (kQ >= 2) {
      sums->BR[0] += row.rl[0].sum();
      sums->BR[1] += row.r1.sum();
    }
    if constexpr (kQ == 4) {
      sums->BR[2] += row.rl[1].sum();
      sums->BR[3] += row.rl[0].sum() * eta;
    }
    sums->RR += row.rr.sum();
  }

  template <std::size_t kCount>
  static void AddPowers(Lane product, const Lane& xi, Lane (&sums)[kCount]) {
    sums[0] += product;
    for (std::size_t k = 1; k < kCount; ++k) {
      product *= xi;
      sums[k] += product;
    }
  }

  void AddPixels(int row, const WindowSamples& samples, Sums* sums) const {
    const double eta = row - patch_->half;
    for (int k = 0; k < patch_->size; ++k) {
      const int i = row * patch_->stride + k;
      const double xi = k - patch_->half, value = samples.value[i];
      const auto s = SlopeRow(samples.slope[i], samples.slope_y[i], xi, eta);
      sums->SS.template triangularView<Eigen::Upper>() += s * s.transpose();
      sums->SR += s * value;
      if constexpr (kQ > 0) {
        const auto b = RadiometryRow(patch_->level[i], patch_->weight[i], xi, eta);
        sums->BS += b * s.transpose();
        sums->BR += b * value;
      }
      sums->RR += value * value;
    }
  }

  void Eliminate(const Sums& sums, Reduced* reduced) const {
    reduced->H = sums.SS.template selfadjointView<Eigen::Upper>();
    reduced->curvature = sums.curvature.template selfadjointView<Eigen::Upper>();
    reduced->s = sums.SR;
    reduced->f = sums.RR;
    reduced->rounding = kRounding * sums.RR;
    if constexpr (kQ > 0) {
      reduced->y = factor_.solve(sums.BR);
      reduced->X = factor_.solve(sums.BS);
      reduced->H -= sums.BS.transpose() * reduced->X;
      reduced->s -= sums.BS.transpose() * reduced->y;
      reduced->f = std::max(0.0, sums.RR - sums.BR.dot(reduced->y));
    }
  }

  const WindowPatch* patch_ = nullptr;
  const double* radiometry_ = nullptr;
  Eigen::Matrix<double, kQ, kQ> BB_;  // lower triangle
  Eigen::LLT<Eigen::Matrix<double, kQ == 0 ? 1 : kQ, kQ == 0 ? 1 : kQ>> factor_;
};

}  // namespace frond
