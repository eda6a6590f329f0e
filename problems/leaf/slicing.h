// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace frond {

// A leaf cut across its length, Wu et al. 2021, section 2.3.2. All in frame coordinates (LeafFrame): x runs
// from base to tip. Slice 0 is the base edge and slice num_slices + 1 the tip, both without thickness.
struct LeafSlices {
  int num_slices = 0;
  double begin = 0;                              // min(x)
  double length = 0;                             // L
  double thickness = 0;                          // W_s = L / num_slices, eq. (1)
  std::vector<std::vector<std::size_t>> points;  // [i − 1]: indices of slice i's points, i = 1 … num_slices
  Eigen::Vector3d base_left, base_middle, base_right;  // P_l0, P_m0, P_r0
  Eigen::Vector3d tip;                                 // P_end

  // Eqs. (2) and (3): the x of slice i's centre plane, i = 0 … num_slices + 1.
  double Plane(int i) const;
};

// `points` in frame coordinates; `petiole_width` in their unit: the base edge is as wide as the blade where
// it first gets that wide. Throws ConfigError unless num_slices ≥ 1 and petiole_width > 0, and InputError
// where the leaf is nowhere as wide as the petiole.
LeafSlices SliceLeaf(std::span<const Eigen::Vector3d> points, int num_slices, double petiole_width);

// `selected` of the slices 0 … num_slices + 1, evenly, the first and the last among them: 7 of 50 + 2 are
// {0, 9, 17, 26, 34, 43, 51}. Throws ConfigError unless 3 ≤ selected ≤ num_slices + 2.
std::vector<int> SelectSlices(int num_slices, int selected);

// The points within `half_thickness` of slice i's plane (1 ≤ i ≤ num_slices), in their order.
std::vector<std::size_t> PointsNearPlane(std::span<const Eigen::Vector3d> points, const LeafSlices& slices,
                                         int i, double half_thickness);

}  // namespace frond
