// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_pixels.h"

#include <cmath>

namespace frond {

std::vector<WindowPixel> PixelsOf(const WindowPatch& patch) {
  std::vector<WindowPixel> pixels;
  pixels.reserve(static_cast<std::size_t>(patch.pixels));
  for (int row = 0; row < patch.size; ++row) {
    for (int k = 0; k < patch.size; ++k) {
      const int i = row * patch.stride + k;
      if (patch.weight[i] == 0) continue;
      pixels.push_back({.xi = static_cast<double>(k - patch.half),
                        .eta = static_cast<double>(row - patch.half),
                        .level = patch.level[i]});
    }
  }
  return pixels;
}

RadiometryValues StartRadiometry(const WindowImages& images, const WindowModel& model, int x, int y,
                                 const std::vector<WindowPixel>& pixels, const WarpValues& warp) {
  if (model.radiometry == RadiometryKind::kNone) return {1, 0, 0, 0};
  // The nearest pixels of the counterpart do.
  const double v = model.warp == WarpKind::kAffine ? warp[3] : 0;
  double l = 0, ll = 0, r = 0, rr = 0;
  for (const WindowPixel& pixel : pixels) {
    const int row = std::clamp(y + static_cast<int>(pixel.eta - v), 0, images.right->height() - 1);
    const double value = images.right->AtRow(x + pixel.xi - warp[0], row).value;
    l += pixel.level;
    ll += pixel.level * pixel.level;
    r += value;
    rr += value * value;
  }
  const auto n = static_cast<double>(pixels.size());
  const double left = ll - l * l / n, right = rr - r * r / n;
  const double gain = left > 0 && right > 0 ? std::sqrt(right / left) : 1;
  return {gain, (r - gain * l) / n, 0, 0};
}

}  // namespace frond
