// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "models/cubic_image.h"
#include "models/radiometry.h"
#include "models/window_warp.h"

namespace frond {

// A pixel of a window that takes part.
struct WindowPixel {
  double xi = 0, eta = 0;  // offset from the centre
  double level = 0;        // L
};

// The residual of pixel i of a window,
//
//   r_i = R(x + ξ − u(ξ, η), y + η − v(ξ, η)) − radiometry(L_i, ξ, η)      [grey levels]
//
// over the parameter blocks warp (WarpSize(kWarp) values) and, unless the radiometry is none, radiometry
// (RadiometrySize(kRadiometry) values). The pixels and the right image must outlive it.
template <WarpKind kWarp, RadiometryKind kRadiometry>
struct WindowResidual {
  const CubicImage* right;
  int x, y;  // the centre
  const std::vector<WindowPixel>* pixels;

  template <typename T>
  bool operator()(int i, const T* warp, const T* radiometry, T* residual) const {
    const auto& [xi, eta, level] = (*pixels)[static_cast<std::size_t>(i)];
    const T right_x = x + xi - WarpDisparity<kWarp>(warp, xi, eta);
    T value;
    if constexpr (StaysInRow(kWarp)) {
      value = right->ValueAtRow(right_x, y + static_cast<int>(eta));
    } else {
      value = right->ValueAt(right_x, T(y + eta - WarpVerticalShift(warp, xi, eta)));
    }
    residual[0] = value - ApplyRadiometry<kRadiometry>(radiometry, level, xi, eta);
    return true;
  }

  template <typename T>
  bool operator()(int i, const T* warp, T* residual) const {
    return (*this)(i, warp, static_cast<const T*>(nullptr), residual);
  }
};

}  // namespace frond
