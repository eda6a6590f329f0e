// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/boundary_ring.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <unordered_map>

namespace frond {
namespace {

namespace polygon = boost::polygon;
using Diagram = polygon::voronoi_diagram<double>;

struct GridPoint {
  int x, y;
};

}  // namespace
}  // namespace frond

namespace boost::polygon {
template <>
struct geometry_concept<frond::GridPoint> {
  using type = point_concept;
};
template <>
struct point_traits<frond::GridPoint> {
  using coordinate_type = int;
  static int get(const frond::GridPoint& point, orientation_2d axis) {
    return axis == HORIZONTAL ? point.x : point.y;
  }
};
}  // namespace boost::polygon

namespace frond {
namespace {

// Directed Delaunay edges with a kept triangle on their left and none on their right, by their first point.
using BoundaryEdges = std::unordered_multimap<std::uint32_t, std::uint32_t>;

BoundaryEdges FindBoundaryEdges(const std::vector<GridPoint>& grid, double radius) {
  Diagram diagram;
  polygon::construct_voronoi(grid.begin(), grid.end(), &diagram);
  const auto kept = [&](const Diagram::vertex_type* vertex) {  // its colour, from the circumradius
    return vertex != nullptr && vertex->color() != 0;
  };
  for (const auto& vertex : diagram.vertices()) {
    const GridPoint& site = grid[vertex.incident_edge()->cell()->source_index()];
    vertex.color(std::hypot(vertex.x() - site.x, vertex.y() - site.y) <= radius ? 1 : 0);
  }
  BoundaryEdges edges;
  for (const auto& edge : diagram.edges()) {
    // The Voronoi edge runs from vertex0 to vertex1 with its own site on the left, so the triangle of vertex1
    // lies left of the Delaunay edge from its own site to the twin's.
    if (edge.is_secondary() || !kept(edge.vertex1()) || kept(edge.vertex0())) continue;
    edges.emplace(static_cast<std::uint32_t>(edge.cell()->source_index()),
                  static_cast<std::uint32_t>(edge.twin()->cell()->source_index()));
  }
  return edges;
}

// Where the boundary touches itself the walk goes on along the edge that turns most to the right as seen from
// the inside, which splits the touching parts into loops of their own.
BoundaryEdges::iterator NextEdge(BoundaryEdges& edges, const std::vector<GridPoint>& grid, std::uint32_t from,
                                 std::uint32_t at) {
  const auto [first, last] = edges.equal_range(at);
  if (first == last) return edges.end();
  const double back = std::atan2(static_cast<double>(grid[from].y) - grid[at].y,
                                 static_cast<double>(grid[from].x) - grid[at].x);
  auto best = edges.end();
  double best_turn = 0;
  for (auto edge = first; edge != last; ++edge) {
    const double direction = std::atan2(static_cast<double>(grid[edge->second].y) - grid[at].y,
                                        static_cast<double>(grid[edge->second].x) - grid[at].x);
    double turn = std::fmod(back - direction + 4 * M_PI, 2 * M_PI);  // clockwise from the way back
    if (turn == 0) turn = 2 * M_PI;
    if (best == edges.end() || turn < best_turn) {
      best = edge;
      best_turn = turn;
    }
  }
  return best;
}

double TwiceArea(const std::vector<std::uint32_t>& loop, const std::vector<GridPoint>& grid) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const GridPoint &a = grid[loop[i]], &b = grid[loop[(i + 1) % loop.size()]];
    sum += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
  }
  return sum;
}

// A walk that comes back to a point it has passed gives off the loop between as one of its own.
void SplitLoops(const std::vector<std::uint32_t>& walk, std::vector<std::vector<std::uint32_t>>* loops) {
  std::vector<std::uint32_t> path;
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (const std::uint32_t point : walk) {
    if (const auto seen = place.find(point); seen != place.end()) {
      const std::size_t begin = seen->second;
      loops->emplace_back(path.begin() + static_cast<std::ptrdiff_t>(begin), path.end());
      for (std::size_t k = begin; k < path.size(); ++k) place.erase(path[k]);
      path.resize(begin);
    }
    place[point] = path.size();
    path.push_back(point);
  }
  loops->push_back(std::move(path));
}

}  // namespace

std::vector<std::uint32_t> BoundaryRing(std::span<const Eigen::Vector2d> points, double radius) {
  Eigen::AlignedBox2d box;
  for (const auto& point : points) box.extend(point);
  if (points.size() < 3 || !(box.sizes().maxCoeff() > 0)) return {};
  const double scale = 0x1p29 / box.sizes().maxCoeff();
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Vector2d scaled = scale * (point - box.min());
    grid.push_back({static_cast<int>(std::lround(scaled.x())), static_cast<int>(std::lround(scaled.y()))});
  }
  BoundaryEdges edges = FindBoundaryEdges(grid, radius * scale);
  // Walks begin at the lowest index that is left, so that the result does not hang on a hash's order.
  std::vector<std::uint32_t> starts;
  for (const auto& edge : edges) starts.push_back(edge.first);
  std::sort(starts.begin(), starts.end());
  std::vector<std::vector<std::uint32_t>> loops;
  for (const std::uint32_t start : starts) {
    auto edge = edges.find(start);
    std::vector<std::uint32_t> walk;
    while (edge != edges.end()) {
      const auto [from, at] = *edge;
      walk.push_back(from);
      edges.erase(edge);
      edge = at == start ? edges.end() : NextEdge(edges, grid, from, at);
    }
    if (walk.size() >= 3) SplitLoops(walk, &loops);
  }
  const auto largest = std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
    return TwiceArea(a, grid) < TwiceArea(b, grid);
  });
  return largest == loops.end() || largest->size() < 3 ? std::vector<std::uint32_t>() : *largest;
}

}  // namespace frond
