// SPDX-License-Identifier: BSD-3-Clause
// The edges of a triangle mesh and the faces at them, by indices alone.
#pragma once

#include <cstddef>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// Side k of a face runs from its corner k to corner k + 1. A side and the corner that it starts at have the
// same number: 3 · face + k.
int MeshCorner(const SurfaceMesh& mesh, int side);  // the vertex
inline int NextSide(int side) { return side % 3 == 2 ? side - 2 : side + 1; }

// One side at an edge; `forward` from the lower to the higher vertex.
struct HalfEdge {
  int high = 0;
  int side = 0;
  bool forward = false;
};

// Sides by their lower vertex: those of vertex v are [first[v], first[v + 1]), by `high`, then `side`.
struct EdgeTable {
  std::vector<std::size_t> first;
  std::vector<HalfEdge> half_edges;
};

// Linear in time for bounded valence.
EdgeTable TableOfEdges(const SurfaceMesh& mesh);

// Calls visit(low vertex, first half-edge, one past the last) for each edge.
template <typename Visit>
void ForEachEdge(const EdgeTable& table, const Visit& visit) {
  for (std::size_t v = 0; v + 1 < table.first.size(); ++v) {
    for (std::size_t i = table.first[v], end = table.first[v + 1]; i < end;) {
      std::size_t j = i + 1;
      while (j < end && table.half_edges[j].high == table.half_edges[i].high) ++j;
      visit(static_cast<int>(v), table.half_edges.data() + i, table.half_edges.data() + j);
      i = j;
    }
  }
}

// A number for each corner: two corners at a vertex have the same one where their faces hang together by
// edges at that vertex. A vertex of a manifold has one fan.
std::vector<int> FansOfCorners(const SurfaceMesh& mesh, const EdgeTable& table);

}  // namespace frond
