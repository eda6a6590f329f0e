// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "problems/leaf/slicing.h"

namespace frond {

enum class PointSetKind { kOrdered, kUnordered };

struct PointSetOptions {
  PointSetKind kind = PointSetKind::kUnordered;
  int slices = 50;           // num_s
  int selected = 7;          // l + 1, base and tip included
  double petiole_width = 2;  // in the points' unit
  int left = 2, right = 2;   // t_l, t_r: points between margin and midrib
  double midrib_threshold = 0.5;
};

// The point set to be fitted (PSF), Wu et al. 2021, section 2.3.3, in frame coordinates. rows[j] is the j-th
// selected slice, from base to tip; its points run across from the left margin to the right one. The rows of
// an ordered set are all of left + right + 3 points; those of an unordered one hold all points of their
// slices, projected on its centre plane and sorted from left to right, but for base and tip, which are as in
// an ordered one. The tip's row is one point repeated.
struct PointSet {
  PointSetKind kind = PointSetKind::kUnordered;  // what was made, see `warnings`
  std::vector<int> selected;                     // slice numbers
  std::vector<std::vector<Eigen::Vector3d>> rows;
  double midrib_offset = 0;  // see MidribOffset
  std::vector<std::string> warnings;
};

// Margin and midrib of a slice: its leftmost (+y), highest (+z) and rightmost points.
struct SliceFeatures {
  Eigen::Vector3d left, top, right;
};

// Found in the middle half of slice i's thickness, or in all of it where fewer than three points lie there.
// Throws InputError where the slice has fewer than three points.
SliceFeatures FindSliceFeatures(std::span<const Eigen::Vector3d> points, const LeafSlices& slices, int i);

// How far the highest points lie from the middle between the margins, over the half-width: the median of the
// slices `of` (base and tip are skipped). Near 0 where the midrib stands out, near 1 where it does not.
double MidribOffset(std::span<const Eigen::Vector3d> points, const LeafSlices& slices,
                    std::span<const int> of);

// Falls back from ordered to unordered, with a warning, where MidribOffset is above the threshold. Slices
// with too few points (holes, sparse clouds) are thickened, with a warning. Throws ConfigError and InputError
// as SliceLeaf and SelectSlices, and InputError where no thickening helps.
PointSet MakePointSet(std::span<const Eigen::Vector3d> points, const PointSetOptions& options);

// The paper's subset for judging a fit: `slices` slices, in each left + right + 3 points picked as in an
// ordered set (90 by default). Where no midrib stands out (`midrib_threshold`), the point nearest to the
// middle between the margins stands in for the highest one, so that the subset stays spread over the blade.
struct TestSubsetOptions {
  int slices = 10;
  int left = 3, right = 3;
  double midrib_threshold = 0.5;
};
std::vector<Eigen::Vector3d> MakeTestSubset(std::span<const Eigen::Vector3d> points,
                                            const TestSubsetOptions& options);

}  // namespace frond
