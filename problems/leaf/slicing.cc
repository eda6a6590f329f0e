// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/slicing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.h"

namespace frond {
namespace {

std::string Shown(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// Slice 0: from the base on, until its points span the petiole's width; its edge lies at min(x).
void FindBase(std::span<const Eigen::Vector3d> points, const std::vector<std::size_t>& by_x,
              double petiole_width, LeafSlices* slices) {
  double low = std::numeric_limits<double>::infinity(), high = -low, height = 0;
  double count = 0;
  for (const std::size_t i : by_x) {
    low = std::min(low, points[i].y());
    high = std::max(high, points[i].y());
    height += points[i].z();
    ++count;
    if (high - low >= petiole_width) break;
  }
  if (high - low < petiole_width) {
    throw InputError("the leaf is " + Shown(high - low) + " wide, less than point_set.petiole_width = " +
                     Shown(petiole_width) + "; is the unit right?");
  }
  height /= count;
  slices->base_left = {slices->begin, high, height};
  slices->base_right = {slices->begin, low, height};
  slices->base_middle = 0.5 * (slices->base_left + slices->base_right);
}

}  // namespace

double LeafSlices::Plane(int i) const {
  if (i <= 0) return begin;
  if (i > num_slices) return begin + length;
  return begin + (i - 0.5) * thickness;
}

LeafSlices SliceLeaf(std::span<const Eigen::Vector3d> points, int num_slices, double petiole_width) {
  if (num_slices < 1) throw ConfigError("point_set.slices must be at least 1");
  if (!(petiole_width > 0)) throw ConfigError("point_set.petiole_width must be above 0");
  if (points.empty()) throw InputError("a leaf without points cannot be sliced");
  std::vector<std::size_t> by_x(points.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(),
            [&](std::size_t a, std::size_t b) { return points[a].x() < points[b].x(); });
  LeafSlices slices;
  slices.num_slices = num_slices;
  slices.begin = points[by_x.front()].x();
  const double end = points[by_x.back()].x();
  slices.length = end - slices.begin;
  slices.thickness = slices.length / num_slices;
  slices.points.resize(static_cast<std::size_t>(num_slices));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = std::floor((points[i].x() - slices.begin) / slices.thickness);
    slices.points[static_cast<std::size_t>(std::clamp(place, 0.0, num_slices - 1.0))].push_back(i);
  }
  FindBase(points, by_x, petiole_width, &slices);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (auto i = by_x.rbegin(); i != by_x.rend() && points[*i].x() == end; ++i, ++count) sum += points[*i];
  slices.tip = sum / count;
  return slices;
}

std::vector<int> SelectSlices(int num_slices, int selected) {
  if (selected < 3 || selected > num_slices + 2) {
    throw ConfigError("point_set.selected is " + std::to_string(selected) +
                      ", must be in [3, slices + 2 = " + std::to_string(num_slices + 2) + "]");
  }
  std::vector<int> chosen;
  for (int k = 0; k < selected; ++k) {
    // k (num_slices + 1) / (selected − 1), halves rounded up, in integers.
    chosen.push_back((2 * k * (num_slices + 1) + selected - 1) / (2 * (selected - 1)));
  }
  return chosen;
}

std::vector<std::size_t> PointsNearPlane(std::span<const Eigen::Vector3d> points, const LeafSlices& slices,
                                         int i, double half_thickness) {
  std::vector<std::size_t> near;
  const double plane = slices.Plane(i);
  const int reach = static_cast<int>(std::ceil(half_thickness / slices.thickness + 0.5));
  const int last = std::min(slices.num_slices, i + reach);
  for (int s = std::max(1, i - reach); s <= last; ++s) {
    for (const std::size_t k : slices.points[static_cast<std::size_t>(s - 1)]) {
      if (std::abs(points[k].x() - plane) <= half_thickness) near.push_back(k);
    }
  }
  return near;
}

}  // namespace frond
