// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/window_model.h"

#include "base/errors.h"
#include "models/smoothing.h"

namespace frond {
namespace {

std::size_t IndexOf(const std::string& name, const std::vector<std::string>& names, const char* what) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
    all += (i == 0 ? "" : ", ") + names[i];
  }
  throw ConfigError("unknown " + std::string(what) + " '" + name + "', expected one of " + all);
}

std::string SizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

}  // namespace

const std::vector<std::string>& WarpNames() {
  static const std::vector<std::string> names = {"shift", "linear", "quadratic", "affine"};
  return names;
}

const std::vector<std::string>& RadiometryNames() {
  static const std::vector<std::string> names = {"none", "gain_offset", "planar_gain"};
  return names;
}

WarpKind WarpFrom(const std::string& name) {
  return static_cast<WarpKind>(IndexOf(name, WarpNames(), "warp of a window"));
}

RadiometryKind RadiometryFrom(const std::string& name) {
  return static_cast<RadiometryKind>(IndexOf(name, RadiometryNames(), "radiometry of a window"));
}

void CheckWindowModel(const WindowModel& model) {
  if (model.size < 3 || model.size > kMaxWindowSize || model.size % 2 == 0) {
    throw ConfigError("a window of " + std::to_string(model.size) +
                      " pixels a side: expected an odd number from 3 to " + std::to_string(kMaxWindowSize));
  }
  if (!(model.smoothing >= 0 && model.smoothing <= kLargestSmoothing)) {
    throw ConfigError("images smoothed by " + std::to_string(model.smoothing) +
                      " px: expected a number from 0 to " + std::to_string(kLargestSmoothing));
  }
}

void WindowImages::Check() const {
  if (left == nullptr || right == nullptr || left->empty() || right->empty()) {
    throw InputError("a stereo pair needs a left and a right image, and one of them is empty");
  }
  const auto check = [](const Mask* mask, int width, int height, const char* side) {
    if (mask == nullptr || mask->empty() || (mask->width == width && mask->height == height)) return;
    throw InputError("the " + std::string(side) + " mask has " + SizeText(mask->width, mask->height) +
                     " pixels, its image " + SizeText(width, height));
  };
  if (left->height != right->height()) {
    throw InputError("the left image has " + SizeText(left->width, left->height) + " pixels, the right one " +
                     SizeText(right->width(), right->height()) + ": normal images share their rows");
  }
  check(left_mask, left->width, left->height, "left");
  check(right_mask, right->width(), right->height(), "right");
}

}  // namespace frond
