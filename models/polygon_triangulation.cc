// SPDX-License-Identifier: BSD-3-Clause
#include "models/polygon_triangulation.h"

#include <algorithm>
#include <limits>

namespace frond {
namespace {

using Wide = __int128;  // products of two 52-bit differences

std::size_t At(int i) { return static_cast<std::size_t>(i); }

Wide Cross(const LatticePoint& o, const LatticePoint& a, const LatticePoint& b) {
  return static_cast<Wide>(a.u - o.u) * (b.v - o.v) - static_cast<Wide>(a.v - o.v) * (b.u - o.u);
}

Wide Dot(const LatticePoint& o, const LatticePoint& a, const LatticePoint& b) {
  return static_cast<Wide>(a.u - o.u) * (b.u - o.u) + static_cast<Wide>(a.v - o.v) * (b.v - o.v);
}

// q on the closed segment ab.
bool OnSegment(const LatticePoint& a, const LatticePoint& b, const LatticePoint& q) {
  return Turn(a, b, q) == 0 && Dot(q, a, b) <= 0;
}

// The open segment ab meets the closed segment cd elsewhere than in a common end point.
bool Blocks(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  if (c != a && c != b && OnSegment(a, b, c)) return true;
  if (d != a && d != b && OnSegment(a, b, d)) return true;
  if (a == c || a == d || b == c || b == d) return false;
  return Turn(a, b, c) * Turn(a, b, d) <= 0 && Turn(c, d, a) * Turn(c, d, b) <= 0;
}

// q seen from the corner `at` of a polygon (inside on its left) through its inside.
bool InCorner(const LatticePoint& previous, const LatticePoint& at, const LatticePoint& next,
              const LatticePoint& q) {
  if (Turn(previous, at, next) > 0) return Turn(at, next, q) > 0 && Turn(previous, at, q) > 0;
  return !(Turn(at, next, q) <= 0 && Turn(previous, at, q) <= 0);
}

bool AnyEdgeBlocks(std::span<const LatticePoint> points, const std::vector<int>& polygon,
                   const LatticePoint& a, const LatticePoint& b) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (Blocks(a, b, points[At(polygon[k])], points[At(polygon[(k + 1) % polygon.size()])])) return true;
  }
  return false;
}

// Joins holes[h] to the outer polygon by a bridge of two opposite edges, from the hole's corner of largest u.
void BridgeHole(std::span<const LatticePoint> points, std::vector<int>& outer,
                const std::vector<std::vector<int>>& holes, std::size_t h) {
  std::vector<int> hole = holes[h];
  std::rotate(
      hole.begin(),
      std::max_element(hole.begin(), hole.end(), [&](int a, int b) { return points[At(a)] < points[At(b)]; }),
      hole.end());
  const LatticePoint& from = points[At(hole[0])];
  std::size_t best = outer.size();
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const LatticePoint& to = points[At(outer[k])];
    const auto distance = static_cast<double>(Dot(from, to, to));
    const LatticePoint& previous = points[At(outer[(k + outer.size() - 1) % outer.size()])];
    const LatticePoint& next = points[At(outer[(k + 1) % outer.size()])];
    if (distance >= best_distance || !InCorner(previous, to, next, from)) continue;
    bool blocked = AnyEdgeBlocks(points, outer, from, to);
    for (std::size_t other = h; other < holes.size() && !blocked; ++other) {
      blocked = AnyEdgeBlocks(points, holes[other], from, to);
    }
    if (blocked) continue;
    best = k;
    best_distance = distance;
  }
  if (best == outer.size()) return;  // only where loops cross
  std::vector<int> bridge = hole;
  bridge.push_back(hole[0]);
  bridge.push_back(outer[best]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(best) + 1, bridge.begin(), bridge.end());
}

class EarClipper {
 public:
  EarClipper(std::span<const LatticePoint> points, std::vector<int> polygon)
      : points_(points), polygon_(std::move(polygon)), quality_(polygon_.size()) {
    for (std::size_t k = 0; k < polygon_.size(); ++k) Rate(k);
  }

  std::vector<std::array<int, 3>> Clip() {
    std::vector<std::array<int, 3>> triangles;
    while (polygon_.size() >= 3) {
      const std::size_t k = BestEar();
      const std::size_t n = polygon_.size();
      const std::size_t previous = (k + n - 1) % n, next = (k + 1) % n;
      if (Turn(Point(previous), Point(k), Point(next)) > 0) {
        triangles.push_back({polygon_[previous], polygon_[k], polygon_[next]});
      }
      polygon_.erase(polygon_.begin() + static_cast<std::ptrdiff_t>(k));
      quality_.erase(quality_.begin() + static_cast<std::ptrdiff_t>(k));
      if (polygon_.size() < 3) break;
      Rate(k % polygon_.size());
      Rate((k + polygon_.size() - 1) % polygon_.size());
    }
    return triangles;
  }

 private:
  const LatticePoint& Point(std::size_t k) const { return points_[At(polygon_[k])]; }

  // Ratings of ears stay true as corners go; corners that were not ears may have become some.
  std::size_t BestEar() {
    auto best = std::max_element(quality_.begin(), quality_.end());
    if (*best <= 0) {
      for (std::size_t k = 0; k < polygon_.size(); ++k) Rate(k);
      best = std::max_element(quality_.begin(), quality_.end());
    }
    return static_cast<std::size_t>(best - quality_.begin());
  }

  // Area over longest side squared for an ear; 0 for a corner that is none, −1 for a reflex one.
  void Rate(std::size_t k) {
    const std::size_t n = polygon_.size();
    const LatticePoint &a = Point((k + n - 1) % n), &b = Point(k), &c = Point((k + 1) % n);
    const Wide area = Cross(a, b, c);
    quality_[k] = area > 0 ? 0 : -1;
    if (area <= 0) return;
    for (std::size_t i = 0; i < n; ++i) {
      const LatticePoint& q = Point(i);
      if (q == a || q == b || q == c) continue;
      if (Turn(a, b, q) >= 0 && Turn(b, c, q) >= 0 && Turn(c, a, q) >= 0) return;
    }
    const Wide longest = std::max({Dot(a, b, b), Dot(b, c, c), Dot(c, a, a)});
    quality_[k] = static_cast<double>(area) / static_cast<double>(longest);
  }

  std::span<const LatticePoint> points_;
  std::vector<int> polygon_;
  std::vector<double> quality_;
};

}  // namespace

int Turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  const Wide cross = Cross(a, b, c);
  return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

double TwiceArea(std::span<const LatticePoint> points, std::span<const int> polygon) {
  Wide sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    sum +=
        Cross(points[At(polygon[0])], points[At(polygon[k])], points[At(polygon[(k + 1) % polygon.size()])]);
  }
  return static_cast<double>(sum);
}

bool PolygonHolds(std::span<const LatticePoint> points, std::span<const int> polygon, const LatticePoint& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const LatticePoint &a = points[At(polygon[k])], &b = points[At(polygon[(k + 1) % polygon.size()])];
    if ((a.v > p.v) != (b.v > p.v) && Turn(a, b, p) == (b.v > a.v ? 1 : -1)) inside = !inside;
  }
  return inside;
}

std::size_t FirstClockwise(std::span<const LatticePoint> points, int from, int back,
                           std::span<const int> candidates) {
  const LatticePoint& o = points[At(from)];
  const LatticePoint& r = points[At(back)];
  const auto sector = [&](const LatticePoint& d) {
    const int turn = Turn(o, r, d);
    return turn < 0 ? 0 : turn > 0 ? 2 : Dot(o, r, d) < 0 ? 1 : 3;
  };
  std::size_t first = 0;
  for (std::size_t k = 1; k < candidates.size(); ++k) {
    const LatticePoint &x = points[At(candidates[first])], &y = points[At(candidates[k])];
    const int sector_x = sector(x), sector_y = sector(y);
    if (sector_y < sector_x || (sector_y == sector_x && Turn(o, y, x) < 0)) first = k;
  }
  return first;
}

std::vector<std::array<int, 3>> TriangulatePolygon(std::span<const LatticePoint> points,
                                                   std::vector<int> outer,
                                                   std::vector<std::vector<int>> holes) {
  // From the right to the left: each hole's bridge ends at the outer polygon or at a hole joined before.
  std::sort(holes.begin(), holes.end(), [&](const std::vector<int>& a, const std::vector<int>& b) {
    const auto rightmost = [&](const std::vector<int>& hole) {
      LatticePoint most = points[At(hole[0])];
      for (const int k : hole) most = std::max(most, points[At(k)]);
      return most;
    };
    return rightmost(a) > rightmost(b);
  });
  for (std::size_t h = 0; h < holes.size(); ++h) BridgeHole(points, outer, holes, h);
  return EarClipper(points, std::move(outer)).Clip();
}

}  // namespace frond
