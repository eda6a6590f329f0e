// SPDX-License-Identifier: BSD-3-Clause
// What grey level the right image shows where the left one shows `level`, at the offset (ξ, η) in a window:
//
//   none         level
//   gain_offset  r0 level + r1
//   planar_gain  (r0 + r2 ξ + r3 η) level + r1
//
// Grey levels; the gain's slopes per pixel. Linear in the parameters. Doubles and ceres::Jets alike.
#pragma once

#include <array>

namespace frond {

enum class RadiometryKind { kNone, kGainOffset, kPlanarGain };

constexpr int kMaxRadiometrySize = 4;
using RadiometryValues =
    std::array<double, kMaxRadiometrySize>;  // gain, offset, slopes of the gain in x and y

constexpr int RadiometrySize(RadiometryKind kind) {
  switch (kind) {
    case RadiometryKind::kNone:
      return 0;
    case RadiometryKind::kGainOffset:
      return 2;
    case RadiometryKind::kPlanarGain:
      return 4;
  }
  return 0;
}

template <RadiometryKind kKind, typename T>
T ApplyRadiometry(const T* radiometry, double level, double xi, double eta) {
  if constexpr (kKind == RadiometryKind::kNone) return T(level);
  if constexpr (kKind == RadiometryKind::kGainOffset) return radiometry[0] * level + radiometry[1];
  if constexpr (kKind == RadiometryKind::kPlanarGain) {
    return radiometry[0] * level + radiometry[1] + radiometry[2] * (xi * level) +
           radiometry[3] * (eta * level);
  }
}

}  // namespace frond
