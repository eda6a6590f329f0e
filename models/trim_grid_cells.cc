// SPDX-License-Identifier: BSD-3-Clause
// The part of models/trim_grid.h that turns one cut cell into triangles: its border and the pieces of loops
// in it bound polygons, which are traced and triangulated.
#include <algorithm>
#include <map>

#include "models/trim_grid.h"

namespace frond {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

}  // namespace

TrimGrid::Polygon TrimGrid::RingOf(int i, int j) {
  const std::array<int, 4> corners = CornersOf(i, j);
  const std::array<const GridEdge*, 4> sides = {
      &edges_along_u_[EdgeAlongU(i, j)], &edges_along_v_[EdgeAlongV(i + 1, j)],
      &edges_along_u_[EdgeAlongU(i, j + 1)], &edges_along_v_[EdgeAlongV(i, j)]};
  Polygon ring;
  for (std::size_t side = 0; side < 4; ++side) {
    ring.push_back(corners[side]);
    Polygon between = sides[side]->vertices;
    std::sort(between.begin(), between.end(),
              [&](int a, int b) { return lattice_[At(a)] < lattice_[At(b)]; });
    if (side >= 2) std::reverse(between.begin(), between.end());
    ring.insert(ring.end(), between.begin(), between.end());
  }
  return ring;
}

// Pieces of loops inside the cell; opposite ones cancel.
std::vector<TrimGrid::Edge> TrimGrid::SegmentsOf(int i, int j) const {
  std::vector<Edge> segments;
  const auto found = segments_.find(Cell(i, j));
  if (found == segments_.end()) return segments;
  std::map<Edge, int> net;
  for (const auto& [from, to] : found->second)
    net[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
  for (const auto& [edge, times] : net) {
    if (times > 0) segments.push_back(edge);
    if (times < 0) segments.push_back({edge[1], edge[0]});
  }
  return segments;
}

int TrimGrid::RunsAlong(int i, int j, const LatticePoint& a, const LatticePoint& b) const {
  const bool along_u = a.v == b.v;
  const int line_v = along_u && a.v != v_.lattice_lines[At(j)] ? j + 1 : j;
  const int line_u = !along_u && a.u != u_.lattice_lines[At(i)] ? i + 1 : i;
  const GridEdge& edge =
      along_u ? edges_along_u_[EdgeAlongU(i, line_v)] : edges_along_v_[EdgeAlongV(line_u, j)];
  const std::int64_t from = along_u ? a.u : a.v, to = along_u ? b.u : b.v;
  int net = 0;
  for (const auto& [start, end] : edge.runs) {
    if (std::min(start, end) > std::min(from, to) || std::max(start, end) < std::max(from, to)) continue;
    net += (start < end) == (from < to) ? 1 : -1;
  }
  return net;
}

// Around the border, "inside" begins where a piece of a loop ends on it and ends where one begins. Where none
// does, it is the same all around: told by a loop that runs along the border, or by a point of the border.
std::vector<char> TrimGrid::InsideAlongRing(int i, int j, const Polygon& ring,
                                            const std::vector<Edge>& segments) const {
  std::map<int, int> ends_less_begins;
  for (const auto& [from, to] : segments) {
    --ends_less_begins[from];
    ++ends_less_begins[to];
  }
  const auto change = [&](int vertex) {
    const auto it = ends_less_begins.find(vertex);
    return it == ends_less_begins.end() ? 0 : it->second;
  };
  const std::size_t n = ring.size();
  std::size_t start = 0;
  while (start < n && change(ring[start]) == 0) ++start;
  if (start < n) {
    std::vector<char> inside(n);
    bool now = false;
    for (std::size_t step = 0; step < n; ++step) {
      const std::size_t k = (start + step) % n;
      const int sign = change(ring[k]);
      if (sign != 0) now = sign > 0;
      inside[k] = now;
    }
    return inside;
  }
  if (segments.empty()) return std::vector<char>(n, centre_inside_[Cell(i, j)]);
  for (std::size_t k = 0; k < n; ++k) {
    const LatticePoint &a = lattice_[At(ring[k])], &b = lattice_[At(ring[(k + 1) % n])];
    const int runs = RunsAlong(i, j, a, b);
    if (runs != 0) return std::vector<char>(n, runs > 0);
  }
  const LatticePoint &a = lattice_[At(ring[0])], &b = lattice_[At(ring[1])];
  return std::vector<char>(n, LoopsHold({(a.u + b.u) / 2, (a.v + b.v) / 2}));
}

// Closed chains of the edges; where several leave a vertex, the one that keeps the same inside on its left.
std::vector<TrimGrid::Polygon> TrimGrid::TracePolygons(const std::vector<Edge>& edges) const {
  std::map<int, std::vector<std::size_t>> leaving;
  for (std::size_t k = 0; k < edges.size(); ++k) leaving[edges[k][0]].push_back(k);
  std::vector<char> used(edges.size());
  std::vector<Polygon> polygons;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    Polygon polygon;
    std::size_t edge = start;
    do {
      const auto [from, to] = edges[edge];
      polygon.push_back(from);
      if (edge != start) used[edge] = 1;
      std::vector<std::size_t> next;
      Polygon ends;
      for (const std::size_t k : leaving[to]) {
        if (used[k]) continue;
        next.push_back(k);
        ends.push_back(edges[k][1]);
      }
      if (next.empty()) break;  // only where loops cross each other
      edge = next[next.size() == 1 ? 0 : FirstClockwise(lattice_, to, from, ends)];
    } while (edge != start);
    used[start] = 1;
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

std::vector<std::array<int, 3>> TrimGrid::TrianglesOf(int i, int j) {
  const Polygon ring = RingOf(i, j);
  std::vector<Edge> edges = SegmentsOf(i, j);
  const std::vector<char> inside = InsideAlongRing(i, j, ring, edges);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (inside[k]) edges.push_back({ring[k], ring[(k + 1) % ring.size()]});
  }
  std::vector<Polygon> outers, holes;
  for (Polygon& polygon : TracePolygons(edges)) {
    const double area = TwiceArea(lattice_, polygon);
    if (area != 0) (area > 0 ? outers : holes).push_back(std::move(polygon));
  }
  std::vector<std::array<int, 3>> triangles;
  for (const Polygon& outer : outers) {
    std::vector<Polygon> inner;
    for (const Polygon& hole : holes) {
      if (outers.size() == 1 || PolygonHolds(lattice_, outer, lattice_[At(hole[0])])) inner.push_back(hole);
    }
    const auto pieces = TriangulatePolygon(lattice_, outer, inner);
    triangles.insert(triangles.end(), pieces.begin(), pieces.end());
  }
  return triangles;
}

}  // namespace frond
