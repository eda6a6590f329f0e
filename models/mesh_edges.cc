// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "models/parity_sets.h"

namespace frond {

int MeshCorner(const SurfaceMesh& mesh, int side) {
  return mesh.triangles[static_cast<std::size_t>(side / 3)][static_cast<std::size_t>(side % 3)];
}

EdgeTable TableOfEdges(const SurfaceMesh& mesh) {
  const int sides = 3 * static_cast<int>(mesh.triangles.size());
  const auto low = [&](int side) {
    return static_cast<std::size_t>(std::min(MeshCorner(mesh, side), MeshCorner(mesh, NextSide(side))));
  };
  EdgeTable table;
  table.first.assign(mesh.vertices.size() + 1, 0);
  for (int side = 0; side < sides; ++side) ++table.first[low(side) + 1];
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  table.half_edges.resize(static_cast<std::size_t>(sides));
  std::vector<std::size_t> next(table.first.begin(), table.first.end() - 1);
  for (int side = 0; side < sides; ++side) {
    const int from = MeshCorner(mesh, side), to = MeshCorner(mesh, NextSide(side));
    table.half_edges[next[low(side)]++] = {std::max(from, to), side, from < to};
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto begin = table.half_edges.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(table.first[v]),
              begin + static_cast<std::ptrdiff_t>(table.first[v + 1]),
              [](const HalfEdge& a, const HalfEdge& b) {
                return std::pair(a.high, a.side) < std::pair(b.high, b.side);
              });
  }
  return table;
}

std::vector<int> FansOfCorners(const SurfaceMesh& mesh, const EdgeTable& table) {
  const auto ends = [](const HalfEdge& half) {  // corners at the lower and the higher vertex
    const int next = NextSide(half.side);
    return half.forward ? std::pair(half.side, next) : std::pair(next, half.side);
  };
  ParitySets fans(3 * mesh.triangles.size());
  ForEachEdge(table, [&](int, const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* other = first + 1; other < last; ++other) {
      fans.Join(ends(*first).first, ends(*other).first);
      fans.Join(ends(*first).second, ends(*other).second);
    }
  });
  std::vector<int> fan(3 * mesh.triangles.size());
  for (std::size_t corner = 0; corner < fan.size(); ++corner)
    fan[corner] = fans.Find(static_cast<int>(corner));
  return fan;
}

}  // namespace frond
