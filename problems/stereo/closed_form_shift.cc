// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/closed_form_shift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"

namespace frond {
namespace {

// The left window and the right one at the shifts d − 1, d and d + 1: sums over the pixels that take part.
struct WindowSums {
  static constexpr int kRight = 3;
  int pixels = 0;
  std::array<double, 1 + kRight> sum{};                              // L, w_{d−1}, w_d, w_{d+1}
  std::array<std::array<double, 1 + kRight>, 1 + kRight> product{};  // of each two

  void Add(const std::array<double, 1 + kRight>& values) {
    ++pixels;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      for (std::size_t j = 0; j <= i; ++j) product[i][j] += values[i] * values[j];
    }
  }

  // Of the windows less their means.
  double Centred(std::size_t i, std::size_t j) const {
    return product[std::max(i, j)][std::min(i, j)] - sum[i] * sum[j] / pixels;
  }
  double Norm(std::size_t i) const { return std::sqrt(std::max(0.0, Centred(i, i))); }
  double Correlation(std::size_t i, std::size_t j) const {
    const double norms = Norm(i) * Norm(j);
    return norms > 0 ? Centred(i, j) / norms : 0;
  }
};

bool InMask(const Mask& mask, int x, int y) { return mask.empty() || mask(x, y) != 0; }

WindowSums SumWindows(const Image& left, const Mask& left_mask, const Image& right, const Mask& right_mask,
                      int size, int x, int y, int disparity) {
  WindowSums sums;
  const int half = size / 2;
  for (int v = y - half; v <= y + half; ++v) {
    for (int u = x - half; u <= x + half; ++u) {
      const int first = u - disparity - 1;  // of three neighbours: the right image at d + 1, d, d − 1
      if (!left.Contains(u, v) || !right.Contains(first, v) || !right.Contains(first + 2, v)) continue;
      if (!InMask(left_mask, u, v) || !InMask(right_mask, first, v) || !InMask(right_mask, first + 1, v) ||
          !InMask(right_mask, first + 2, v)) {
        continue;
      }
      sums.Add({left(u, v), right(first + 2, v), right(first + 1, v), right(first, v)});
    }
  }
  return sums;
}

}  // namespace

ClosedFormShift BestShiftBetween(double rho_d, double rho_m, double r, double lambda) {
  ClosedFormShift shift;
  const double numerator = rho_m - r * rho_d;
  const double denominator = lambda * (r * rho_m - rho_d) + r * rho_d - rho_m;
  // The correlation is least, not greatest, at the stationary point where the denominator is not negative.
  if (!(denominator < 0) || !(r * r < 1)) return shift;
  const double tau = numerator / denominator;
  if (!(tau > -1 && tau <= 0)) return shift;
  shift.found = true;
  shift.disparity = tau;
  shift.correlation = std::sqrt((rho_d * rho_d + rho_m * rho_m - 2 * r * rho_d * rho_m) / (1 - r * r));
  return shift;
}

ClosedFormShift MatchClosedForm(const Image& left, const Mask& left_mask, const Image& right,
                                const Mask& right_mask, int size, int x, int y, int disparity) {
  CheckWindowModel({.size = size});
  if (left.height != right.height) {
    throw InputError("the left image has " + std::to_string(left.height) + " rows, the right one " +
                     std::to_string(right.height) + ": normal images share their rows");
  }
  const WindowSums sums = SumWindows(left, left_mask, right, right_mask, size, x, y, disparity);
  ClosedFormShift best;
  if (3 * sums.pixels < size * size) return best;
  for (std::size_t i = 0; i <= WindowSums::kRight; ++i) {
    if (!(sums.Norm(i) > 0)) return best;
  }
  best = {.found = true, .disparity = static_cast<double>(disparity), .correlation = sums.Correlation(0, 2)};
  for (const std::size_t d :
       {std::size_t{2}, std::size_t{3}}) {  // the intervals below and above the disparity
    const ClosedFormShift shift =
        BestShiftBetween(sums.Correlation(0, d), sums.Correlation(0, d - 1), sums.Correlation(d, d - 1),
                         sums.Norm(d - 1) / sums.Norm(d));
    if (!shift.found || shift.correlation <= best.correlation) continue;
    best.correlation = shift.correlation;
    best.disparity = disparity + static_cast<int>(d) - 2 + shift.disparity;
  }
  return best;
}

}  // namespace frond
