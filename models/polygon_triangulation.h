// SPDX-License-Identifier: BSD-3-Clause
// Triangles of plane polygons whose corners have whole coordinates in [0, 2^51]: every decision is exact.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frond {

struct LatticePoint {
  std::int64_t u, v;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

// +1, 0, −1 as a → b → c turns left, goes straight (or back), turns right.
int Turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

// Twice the signed area of a polygon given by indices into `points`, rounded.
double TwiceArea(std::span<const LatticePoint> points, std::span<const int> polygon);

// True where p lies inside the polygon (even-odd rule; undefined on its edges).
bool PolygonHolds(std::span<const LatticePoint> points, std::span<const int> polygon, const LatticePoint& p);

// The first of the directions from → candidates[k] met when the direction from → back is turned clockwise; a
// candidate that equals `back` comes last. With the inside on the left of back → from it continues the
// boundary of that inside.
std::size_t FirstClockwise(std::span<const LatticePoint> points, int from, int back,
                           std::span<const int> candidates);

// Triangles (indices into `points`, counter-clockwise) of the inside of `outer` (counter-clockwise) without
// `holes` (clockwise), by ear clipping, best-shaped ear first. Straight corners (180°) stay corners of
// triangles, and no triangle has area 0. Quadratic in the number of corners. Polygons that cross themselves
// yield some set of triangles with the same boundary.
std::vector<std::array<int, 3>> TriangulatePolygon(std::span<const LatticePoint> points,
                                                   std::vector<int> outer,
                                                   std::vector<std::vector<int>> holes);

}  // namespace frond
