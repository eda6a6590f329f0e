// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frond {

// width × height values, row by row from the top; (x, y) counts columns and rows from 0. The centre of pixel
// (x, y) has the image coordinates (x, y), as in OpenCV.
template <typename Value>
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<Value> values = {};

  Raster() = default;
  Raster(int columns, int rows, Value value = Value())
      : width(columns),
        height(rows),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}

  bool empty() const { return values.empty(); }
  bool Contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  Value& operator()(int x, int y) { return values[Index(x, y)]; }
  const Value& operator()(int x, int y) const { return values[Index(x, y)]; }
};

using Image = Raster<float>;  // grey levels, 0 (black) to 255 (white), whatever the depth of the file
using ColourImage = Raster<std::array<std::uint8_t, 3>>;  // red, green, blue
using Mask = Raster<std::uint8_t>;                        // 1: belongs to the object, 0: does not

}  // namespace frond
