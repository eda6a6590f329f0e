// SPDX-License-Identifier: BSD-3-Clause
// One window of a stereo pair: its model, its pixels, and what a match of it says.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "models/cubic_image.h"
#include "models/radiometry.h"
#include "models/raster.h"
#include "models/window_warp.h"

namespace frond {

// The cost is ½ Σ (R(x + ξ − u, y + η − v) − radiometry(L(x + ξ, y + η)))² over the window's pixels.
struct WindowModel {
  int size = 15;  // pixels a side, odd, at most kMaxWindowSize
  WarpKind warp = WarpKind::kLinear;
  RadiometryKind radiometry = RadiometryKind::kPlanarGain;
  // Standard deviation, px, of the Gaussian that both images have been smoothed with (models/smoothing.h):
  // their noise then varies together from pixel to pixel, and sigma has to know. 0.7 … 1 px takes off noise
  // that texture does not have, and with it a third of the error on weak texture.
  double smoothing = 0;
};

constexpr int kMaxWindowSize = 63;

// "shift", "linear", …; "none", "gain_offset", …: the names in configs. From: throws ConfigError.
const std::vector<std::string>& WarpNames();
const std::vector<std::string>& RadiometryNames();
WarpKind WarpFrom(const std::string& name);
RadiometryKind RadiometryFrom(const std::string& name);

// Throws ConfigError naming the size.
void CheckWindowModel(const WindowModel& model);

struct WindowMatch {
  bool converged = false;
  WarpValues warp{};                        // the disparity u first: models/window_warp.h
  RadiometryValues radiometry{1, 0, 0, 0};  // models/radiometry.h
  // Standard deviation of the disparity at the centre (affine: of u), px, by the noise that the residuals
  // show; infinite where the texture is no stronger than the noise.
  double sigma = std::numeric_limits<double>::infinity();
  double noise = 0;        // RMS residual, grey levels
  double correlation = 0;  // of the right image's window with the left one's, −1 … 1
  int pixels = 0;          // that took part
  int iterations = 0;
  std::int64_t evaluations = 0;  // charged, of a registered solver: solvers/solver.h
};

// The two images of a pair with their masks (empty: all ones). What is pointed at must outlive this.
struct WindowImages {
  const Image* left = nullptr;
  const Mask* left_mask = nullptr;
  const CubicImage* right = nullptr;
  const Mask* right_mask = nullptr;

  // Throws InputError naming the sizes where images and masks do not fit.
  void Check() const;
};

}  // namespace frond
