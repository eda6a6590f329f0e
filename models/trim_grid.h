// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "models/nurbs_surface.h"
#include "models/polygon_triangulation.h"

namespace frond {

// The lines of one direction of a parameter grid: rising values of the domain, and the same on a lattice of
// 2^50 steps over the domain, on which cutting is exact.
struct GridAxis {
  std::vector<double> lines;
  std::vector<std::int64_t> lattice_lines;
  bool periodic = false;

  GridAxis(const BSplineBasis& basis, int segments_per_span);
  int cells() const { return static_cast<int>(lines.size()) - 1; }
  std::int64_t ToLattice(double t) const;
};

// The inside of trim loops cut up by a grid over the domain. Vertices are grid nodes (made when asked for),
// corners of the loops and crossings of the loops with grid lines; there is one for each place. Points of
// loops nearer than 1e-10 of the domain to a grid line lie on it. Throws InputError where a loop leaves the
// domain or has a value that is not finite.
class TrimGrid {
 public:
  TrimGrid(GridAxis u, GridAxis v, const std::vector<TrimLoop>& trim);

  const GridAxis& u() const { return u_; }
  const GridAxis& v() const { return v_; }

  // How much of a cell is inside. kWhole: all of it, and no vertex but its corners lies on its border.
  enum class Inside { kNone, kWhole, kCut };
  Inside StateOf(int i, int j) const;

  std::array<int, 4> CornersOf(int i, int j);  // counter-clockwise vertices, from (i, j)
  std::vector<std::array<int, 3>> TrianglesOf(int i, int j);

  const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  const LatticePoint& lattice_point(int vertex) const { return lattice_[static_cast<std::size_t>(vertex)]; }

 private:
  // What lies on the line between two neighbouring nodes: vertices, and stretches [from, to] that loops run
  // along (in lattice steps; from > to where against the line).
  struct GridEdge {
    std::vector<int> vertices;
    std::vector<std::array<std::int64_t, 2>> runs;
  };
  using Polygon = std::vector<int>;

  using Edge = std::array<int, 2>;  // from vertex, to vertex; the inside on its left

  int VertexAt(const LatticePoint& at, const Eigen::Vector2d& uv);
  void PutOnEdge(int vertex);
  int Node(int i, int j);
  Polygon CleanLoop(const TrimLoop& loop);
  void OrientLoops();
  void AddSegment(int from, int to);
  void AddPiece(int from, int to);
  void ShareSeams();
  void FindCentresInside();
  bool LoopsHold(const LatticePoint& at) const;

  // Of a cut cell: the vertices of its border, counter-clockwise; whether the cell is inside along each
  // border piece from ring[k] to ring[k + 1]; how often (net) loops run along such a piece.
  Polygon RingOf(int i, int j);
  std::vector<char> InsideAlongRing(int i, int j, const Polygon& ring,
                                    const std::vector<Edge>& segments) const;
  int RunsAlong(int i, int j, const LatticePoint& a, const LatticePoint& b) const;
  std::vector<Edge> SegmentsOf(int i, int j) const;
  std::vector<Polygon> TracePolygons(const std::vector<Edge>& edges) const;

  std::size_t Cell(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(v_.cells()) + static_cast<std::size_t>(j);
  }
  std::size_t EdgeAlongU(int i, int line) const {  // from node (i, line) to (i + 1, line)
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(u_.cells()) +
           static_cast<std::size_t>(i);
  }
  std::size_t EdgeAlongV(int line, int j) const {  // from node (line, j) to (line, j + 1)
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(v_.cells()) +
           static_cast<std::size_t>(j);
  }

  struct LatticeHash {
    std::size_t operator()(const LatticePoint& p) const {
      const auto u = static_cast<std::uint64_t>(p.u), v = static_cast<std::uint64_t>(p.v);
      const std::uint64_t mixed = (u * 0x9E3779B97F4A7C15u) ^ (v * 0xC2B2AE3D27D4EB4Fu);
      return static_cast<std::size_t>(mixed ^ (mixed >> 29));
    }
  };

  GridAxis u_, v_;
  bool trimmed_;
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<LatticePoint> lattice_;
  std::unordered_map<LatticePoint, int, LatticeHash> vertex_at_;
  std::vector<Polygon> loops_;                                   // the inside on their left
  std::unordered_map<std::size_t, std::vector<Edge>> segments_;  // of each cut cell
  std::vector<GridEdge> edges_along_u_, edges_along_v_;
  std::vector<char> centre_inside_;
};

}  // namespace frond
