// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_patch.h"

#include <cmath>

namespace frond {
namespace {

// (u, v) of the warp at (ξ, η).
template <WarpKind kKind>
std::array<double, 2> Displacement(const WarpValues& warp, double xi, double eta) {
  const double u = WarpDisparity<kKind>(warp.data(), xi, eta);
  if constexpr (StaysInRow(kKind)) return {u, 0};
  return {u, WarpVerticalShift(warp.data(), xi, eta)};
}

bool InMask(const Mask* mask, int x, int y) { return mask == nullptr || mask->empty() || (*mask)(x, y) != 0; }

template <WarpKind kKind>
bool ChoosePixels(const WindowImages& images, const WarpValues& warp, WindowPatch* patch) {
  const int width = images.right->width(), height = images.right->height();
  bool changed = false;
  patch->pixels = 0;
  for (int row = 0; row < patch->size; ++row) {
    const int y = patch->y + row - patch->half;
    for (int column = 0; column < patch->size; ++column) {
      const int x = patch->x + column - patch->half, i = row * patch->stride + column;
      bool takes_part = images.left->Contains(x, y) && InMask(images.left_mask, x, y);
      if (takes_part) {
        const auto [u, v] = Displacement<kKind>(warp, column - patch->half, row - patch->half);
        const double right_x = x - u, right_y = y - v;
        takes_part =
            right_x >= 0 && right_y >= 0 && right_x <= width - 1 && right_y <= height - 1 &&
            InMask(images.right_mask, static_cast<int>(right_x + 0.5), static_cast<int>(right_y + 0.5));
      }
      const double weight = takes_part ? 1 : 0;
      changed = changed || weight != patch->weight[i];
      patch->weight[i] = weight;
      patch->level[i] = takes_part ? static_cast<double>((*images.left)(x, y)) : 0;
      patch->pixels += takes_part ? 1 : 0;
    }
  }
  return changed;
}

}  // namespace

void WindowPatch::Load(const WindowImages& images, const WindowModel& model, int centre_x, int centre_y,
                       const WarpValues& warp) {
  x = centre_x;
  y = centre_y;
  size = model.size;
  half = size / 2;
  stride = (size + kLanes - 1) / kLanes * kLanes;
  for (int i = 0; i < size * stride; ++i) level[i] = weight[i] = 0;
  Choose(images, model.warp, warp);
}

bool WindowPatch::Choose(const WindowImages& images, WarpKind kind, const WarpValues& warp) {
  switch (kind) {
    case WarpKind::kShift:
      return ChoosePixels<WarpKind::kShift>(images, warp, this);
    case WarpKind::kLinear:
      return ChoosePixels<WarpKind::kLinear>(images, warp, this);
    case WarpKind::kQuadratic:
      return ChoosePixels<WarpKind::kQuadratic>(images, warp, this);
    case WarpKind::kAffine:
      return ChoosePixels<WarpKind::kAffine>(images, warp, this);
  }
  return false;
}

}  // namespace frond
