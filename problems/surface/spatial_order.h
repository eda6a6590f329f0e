// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

// The order of the points along a Z-curve (Morton codes) through their bounding box: neighbours in space
// stand near each other in memory, every k-th point is an even thinning, and a result that follows from this
// order does not depend on the order in the file. Ties (equal codes) are broken by the coordinates.
std::vector<std::uint32_t> SpatialOrder(std::span<const Eigen::Vector3d> points);

// Every k-th of things in spatial order, so that about `wanted` remain: an even thinning.
template <typename T>
std::vector<T> Thinned(const std::vector<T>& all, std::size_t wanted) {
  const std::size_t stride = std::max<std::size_t>(1, all.size() / std::max<std::size_t>(wanted, 1));
  std::vector<T> some;
  some.reserve(all.size() / stride + 1);
  for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

}  // namespace frond
