// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/point_set.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include "base/errors.h"

namespace frond {
namespace {

using Points = std::span<const Eigen::Vector3d>;
using Indices = std::vector<std::size_t>;

// First by `less` on a coordinate, then on the others: the same point whatever the order of the cloud.
bool Before(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis) {
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  return std::tie(a[axis], a[second], a[third]) < std::tie(b[axis], b[second], b[third]);
}

const Eigen::Vector3d& Nearest(Points points, const Indices& among, const Eigen::Vector3d& place) {
  std::size_t best = among.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : among) {
    const double distance = (points[i] - place).squaredNorm();
    if (distance < least || (distance == least && Before(points[i], points[best], 0))) {
      least = distance;
      best = i;
    }
  }
  return points[best];
}

SliceFeatures Extremes(Points points, const Indices& among) {
  const auto by_y = [&](std::size_t a, std::size_t b) { return Before(points[a], points[b], 1); };
  const auto by_z = [&](std::size_t a, std::size_t b) { return Before(points[a], points[b], 2); };
  const auto [right, left] = std::minmax_element(among.begin(), among.end(), by_y);
  return {points[*left], points[*std::max_element(among.begin(), among.end(), by_z)], points[*right]};
}

// A slice's points and those of its middle half; thickened together until there are `least` and three of
// them.
struct SlicePoints {
  Indices all, middle;
  double thickened = 1;
};

SlicePoints TakeSlice(Points points, const LeafSlices& slices, int i, std::size_t least) {
  SlicePoints taken;
  taken.all = slices.points[static_cast<std::size_t>(i - 1)];
  while (taken.all.size() < std::max<std::size_t>(least, 3)) {
    taken.thickened *= 1.5;
    if (taken.thickened * slices.thickness > 2 * slices.length) {
      throw InputError("the leaf has only " + std::to_string(taken.all.size()) + " points, a slice needs " +
                       std::to_string(least));
    }
    taken.all = PointsNearPlane(points, slices, i, 0.5 * taken.thickened * slices.thickness);
  }
  taken.middle = PointsNearPlane(points, slices, i, 0.25 * taken.thickened * slices.thickness);
  if (taken.middle.size() < 3) taken.middle = taken.all;
  return taken;
}

double OffsetOf(const SliceFeatures& f) {
  const double half_width = 0.5 * (f.left.y() - f.right.y());
  return half_width > 0 ? std::abs(f.top.y() - 0.5 * (f.left.y() + f.right.y())) / half_width : 1;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// Figure 5a: margin, `left` of the slice's points nearest to equal steps, midrib, `right` more, margin.
std::vector<Eigen::Vector3d> OrderedRow(Points points, const Indices& among, const SliceFeatures& f, int left,
                                        int right) {
  std::vector<Eigen::Vector3d> row = {f.left};
  for (int k = 1; k <= left; ++k) {
    row.push_back(Nearest(points, among, f.left + (f.top - f.left) * k / (left + 1.0)));
  }
  row.push_back(f.top);
  for (int k = 1; k <= right; ++k) {
    row.push_back(Nearest(points, among, f.top + (f.right - f.top) * k / (right + 1.0)));
  }
  row.push_back(f.right);
  return row;
}

std::vector<Eigen::Vector3d> BaseRow(const LeafSlices& slices, int left, int right) {
  std::vector<Eigen::Vector3d> row;
  for (int k = 0; k <= left; ++k) {
    row.push_back(slices.base_left + (slices.base_middle - slices.base_left) * k / (left + 1.0));
  }
  for (int k = 0; k <= right + 1; ++k) {
    row.push_back(slices.base_middle + (slices.base_right - slices.base_middle) * k / (right + 1.0));
  }
  return row;
}

// Figure 5b: all points of the slice on its centre plane, from left to right.
std::vector<Eigen::Vector3d> ProjectedRow(Points points, const Indices& among, double plane) {
  std::vector<Eigen::Vector3d> row;
  row.reserve(among.size());
  for (const std::size_t i : among) row.emplace_back(plane, points[i].y(), points[i].z());
  std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return Before(b, a, 1); });
  return row;
}

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

void CheckCounts(int left, int right) {
  if (left < 0 || right < 0) throw ConfigError("point_set.left and point_set.right must not be negative");
}

}  // namespace

SliceFeatures FindSliceFeatures(Points points, const LeafSlices& slices, int i) {
  const Indices& all = slices.points.at(static_cast<std::size_t>(i - 1));
  if (all.size() < 3) {
    throw InputError("slice " + std::to_string(i) + " of the leaf holds " + std::to_string(all.size()) +
                     " points");
  }
  const Indices middle = PointsNearPlane(points, slices, i, 0.25 * slices.thickness);
  return Extremes(points, middle.size() < 3 ? all : middle);
}

double MidribOffset(Points points, const LeafSlices& slices, std::span<const int> of) {
  std::vector<double> offsets;
  for (const int i : of) {
    if (i < 1 || i > slices.num_slices) continue;
    offsets.push_back(OffsetOf(Extremes(points, TakeSlice(points, slices, i, 3).middle)));
  }
  return Median(std::move(offsets));
}

PointSet MakePointSet(Points points, const PointSetOptions& options) {
  CheckCounts(options.left, options.right);
  PointSet set;
  set.kind = options.kind;
  set.selected = SelectSlices(options.slices, options.selected);
  const LeafSlices slices = SliceLeaf(points, options.slices, options.petiole_width);
  set.midrib_offset = MidribOffset(points, slices, set.selected);
  if (set.kind == PointSetKind::kOrdered && set.midrib_offset > options.midrib_threshold) {
    set.kind = PointSetKind::kUnordered;
    set.warnings.push_back("no midrib stands out (the highest points lie " + Short(set.midrib_offset) +
                           " of the half-width off the middle, point_set.midrib_threshold is " +
                           Short(options.midrib_threshold) + "): the point set is unordered instead");
  }
  const std::size_t least =
      static_cast<std::size_t>(options.left) + static_cast<std::size_t>(options.right) + 3;
  for (const int i : set.selected) {
    if (i == 0) {
      set.rows.push_back(BaseRow(slices, options.left, options.right));
    } else if (i > options.slices) {
      set.rows.emplace_back(least, slices.tip);
    } else {
      const SlicePoints taken = TakeSlice(points, slices, i, least);
      if (taken.thickened > 1) {
        set.warnings.push_back("slice " + std::to_string(i) + " has too few points and was made " +
                               Short(taken.thickened) + " times as thick");
      }
      set.rows.push_back(
          set.kind == PointSetKind::kOrdered
              ? OrderedRow(points, taken.all, Extremes(points, taken.middle), options.left, options.right)
              : ProjectedRow(points, taken.all, slices.Plane(i)));
    }
  }
  return set;
}

std::vector<Eigen::Vector3d> MakeTestSubset(Points points, const TestSubsetOptions& options) {
  CheckCounts(options.left, options.right);
  // The base edge is not part of the subset, so the petiole's width does not matter.
  const LeafSlices slices = SliceLeaf(points, options.slices, std::numeric_limits<double>::min());
  std::vector<int> all;
  for (int i = 1; i <= options.slices; ++i) all.push_back(i);
  const bool midrib = MidribOffset(points, slices, all) <= options.midrib_threshold;
  std::vector<Eigen::Vector3d> subset;
  for (const int i : all) {
    const SlicePoints taken = TakeSlice(points, slices, i, 3);
    SliceFeatures features = Extremes(points, taken.middle);
    if (!midrib) features.top = Nearest(points, taken.middle, 0.5 * (features.left + features.right));
    const std::vector<Eigen::Vector3d> row =
        OrderedRow(points, taken.all, features, options.left, options.right);
    subset.insert(subset.end(), row.begin(), row.end());
  }
  return subset;
}

}  // namespace frond
