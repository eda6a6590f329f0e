// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/spatial_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace frond {
namespace {

// The lowest 21 bits of x, two zeros between any two.
std::uint64_t Spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::vector<std::uint32_t> SpatialOrder(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const double extent = points.empty() ? 1 : box.sizes().maxCoeff();
  const double scale = extent > 0 ? 65535 / extent : 0;
  std::vector<std::uint64_t> codes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d cell = scale * (points[i] - box.min());
    codes[i] = Spread(static_cast<std::uint64_t>(cell.x())) |
               Spread(static_cast<std::uint64_t>(cell.y())) << 1 |
               Spread(static_cast<std::uint64_t>(cell.z())) << 2;
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (codes[a] != codes[b]) return codes[a] < codes[b];
    return std::lexicographical_compare(points[a].data(), points[a].data() + 3, points[b].data(),
                                        points[b].data() + 3);
  });
  return order;
}

}  // namespace frond
