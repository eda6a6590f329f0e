// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/mask_edge.h"

#include <array>
#include <utility>

namespace frond {

Mask WithoutEdge(const Mask& mask, int width) {
  constexpr std::array<std::pair<int, int>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  Mask inner = mask;
  for (int step = 0; step < width; ++step) {
    const Mask outer = inner;
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) {
        for (const auto& [dx, dy] : kNeighbours) {
          if (outer.Contains(x + dx, y + dy) && outer(x + dx, y + dy) == 0) inner(x, y) = 0;
        }
      }
    }
  }
  return inner;
}

}  // namespace frond
