// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <utility>

#include "problems/stereo/window_model.h"

namespace frond {

// body(warp, radiometry) with the model's kinds as types: std::integral_constants.
template <typename Body>
auto WithWindowKinds(const WindowModel& model, Body&& body) {
  const auto with_warp = [&](auto warp) {
    using R = RadiometryKind;
    switch (model.radiometry) {
      case R::kNone:
        return body(warp, std::integral_constant<R, R::kNone>());
      case R::kGainOffset:
        return body(warp, std::integral_constant<R, R::kGainOffset>());
      case R::kPlanarGain:
        break;
    }
    return body(warp, std::integral_constant<R, R::kPlanarGain>());
  };
  using W = WarpKind;
  switch (model.warp) {
    case W::kShift:
      return with_warp(std::integral_constant<W, W::kShift>());
    case W::kLinear:
      break;
    case W::kQuadratic:
      return with_warp(std::integral_constant<W, W::kQuadratic>());
    case W::kAffine:
      return with_warp(std::integral_constant<W, W::kAffine>());
  }
  return with_warp(std::integral_constant<W, W::kLinear>());
}

}  // namespace frond
