// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "models/mesh_edges.h"
#include "models/parity_sets.h"

namespace frond {
namespace {

// Walks along boundary edges, given as directed pairs with the face on the left. Where faces are not turned
// alike the walk passes edges against their direction.
std::vector<std::vector<int>> TraceLoops(const std::vector<std::pair<int, int>>& edges,
                                         std::size_t vertices) {
  std::vector<std::size_t> first(vertices + 1, 0);
  for (const auto& [from, to] : edges) {
    ++first[static_cast<std::size_t>(from) + 1];
    ++first[static_cast<std::size_t>(to) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> at(2 * edges.size()), next(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) at[next[static_cast<std::size_t>(edges[e].first)]++] = e;
  for (std::size_t e = 0; e < edges.size(); ++e) at[next[static_cast<std::size_t>(edges[e].second)]++] = e;
  std::vector<std::uint8_t> used(edges.size(), 0);
  std::vector<std::vector<int>> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    std::vector<int> loop = {edges[start].first};
    used[start] = 1;
    int v = edges[start].second;
    while (v != loop.front()) {
      loop.push_back(v);
      const auto begin = at.begin() + static_cast<std::ptrdiff_t>(first[static_cast<std::size_t>(v)]);
      const auto end = at.begin() + static_cast<std::ptrdiff_t>(first[static_cast<std::size_t>(v) + 1]);
      const auto found = std::find_if(begin, end, [&](std::size_t e) { return !used[e]; });
      if (found == end) break;  // not a manifold
      used[*found] = 1;
      v = edges[*found].first == v ? edges[*found].second : edges[*found].first;
    }
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops.push_back(std::move(loop));
  }
  return loops;
}

double LoopLength(const SurfaceMesh& mesh, const std::vector<int>& loop) {
  double length = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const int to = loop[(k + 1) % loop.size()];
    length += (mesh.vertices[static_cast<std::size_t>(to)] - mesh.vertices[static_cast<std::size_t>(loop[k])])
                  .norm();
  }
  return length;
}

void SortLoops(const SurfaceMesh& mesh, std::vector<std::vector<int>>* loops) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < loops->size(); ++k) order.emplace_back(-LoopLength(mesh, (*loops)[k]), k);
  std::sort(order.begin(), order.end());
  std::vector<std::vector<int>> sorted;
  for (const auto& [length, k] : order) sorted.push_back(std::move((*loops)[k]));
  *loops = std::move(sorted);
}

// The components' numbers by a vertex of theirs; -1 for vertices without a face.
std::vector<int> NumberComponents(const SurfaceMesh& mesh, int* count) {
  ParitySets sets(mesh.vertices.size());
  std::vector<int> number(mesh.vertices.size(), -1), of_root(mesh.vertices.size(), -1);
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.Join(a, b);
    sets.Join(a, c);
  }
  *count = 0;
  for (const auto& triangle : mesh.triangles) {
    int& name = of_root[static_cast<std::size_t>(sets.Find(triangle[0]))];
    if (name < 0) name = (*count)++;
    for (const int v : triangle) number[static_cast<std::size_t>(v)] = name;
  }
  return number;
}

}  // namespace

MeshTopology FindMeshTopology(const SurfaceMesh& mesh) {
  MeshTopology topology;
  int count = 0;
  const std::vector<int> number = NumberComponents(mesh, &count);
  std::vector<MeshComponent>& parts = topology.components;
  parts.resize(static_cast<std::size_t>(count));
  const auto part_of = [&](int v) { return static_cast<std::size_t>(number[static_cast<std::size_t>(v)]); };
  // By component.
  std::vector<std::uint8_t> manifold(parts.size(), 1), orientable(parts.size(), 1);
  ParitySets turned(mesh.triangles.size());
  const EdgeTable table = TableOfEdges(mesh);
  std::vector<std::pair<int, int>> boundary;
  topology.oriented = true;
  ForEachEdge(table, [&](int low, const HalfEdge* first, const HalfEdge* last) {
    const std::size_t part = part_of(low);
    ++parts[part].edges;
    if (last - first > 2 || first->high == low) {
      ++topology.non_manifold_edges;
      manifold[part] = 0;
    } else if (last - first == 1) {
      boundary.emplace_back(first->forward ? low : first->high, first->forward ? first->high : low);
    } else {
      const bool alike = first[0].forward != first[1].forward;
      topology.oriented &= alike;
      if (!turned.Join(first[0].side / 3, first[1].side / 3, !alike)) orientable[part] = 0;
    }
  });
  const std::vector<int> fan_of = FansOfCorners(mesh, table);
  std::vector<int> fan(mesh.vertices.size(), -1);  // by vertex; -2: more than one
  for (int corner = 0; corner < 3 * static_cast<int>(mesh.triangles.size()); ++corner) {
    const int v = MeshCorner(mesh, corner), name = fan_of[static_cast<std::size_t>(corner)];
    int& known = fan[static_cast<std::size_t>(v)];
    if (known == -1) ++parts[part_of(v)].vertices;
    if (known >= 0 && known != name) {
      ++topology.non_manifold_vertices;
      manifold[part_of(v)] = 0;
      known = -2;
    } else if (known == -1) {
      known = name;
    }
  }
  for (const auto& triangle : mesh.triangles) ++parts[part_of(triangle[0])].faces;
  topology.boundary_edges = static_cast<int>(boundary.size());
  topology.boundary_loops = TraceLoops(boundary, mesh.vertices.size());
  for (const auto& loop : topology.boundary_loops) ++parts[part_of(loop[0])].rims;
  SortLoops(mesh, &topology.boundary_loops);
  topology.genus = 0;
  topology.orientable = true;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    MeshComponent& part = parts[k];
    part.euler_characteristic = part.vertices - part.edges + part.faces;
    if (manifold[k] && orientable[k]) part.genus = (2 - part.euler_characteristic - part.rims) / 2;
    topology.genus =
        topology.genus && part.genus ? std::optional(*topology.genus + *part.genus) : std::nullopt;
    topology.orientable &= orientable[k] != 0;
    topology.vertices += part.vertices;
    topology.edges += part.edges;
    topology.faces += part.faces;
  }
  topology.euler_characteristic = topology.vertices - topology.edges + topology.faces;
  topology.manifold = topology.non_manifold_edges == 0 && topology.non_manifold_vertices == 0;
  topology.closed = topology.faces > 0 && topology.boundary_edges == 0;
  topology.oriented &= topology.non_manifold_edges == 0;
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.faces > b.faces; });
  return topology;
}

double MeshArea(const SurfaceMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& origin = mesh.vertices[static_cast<std::size_t>(a)];
    area += 0.5 * (mesh.vertices[static_cast<std::size_t>(b)] - origin)
                      .cross(mesh.vertices[static_cast<std::size_t>(c)] - origin)
                      .norm();
  }
  return area;
}

double MeshVolume(const SurfaceMesh& mesh) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& vertex : mesh.vertices) mean += vertex / static_cast<double>(mesh.vertices.size());
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += (mesh.vertices[static_cast<std::size_t>(a)] - mean)
                  .dot((mesh.vertices[static_cast<std::size_t>(b)] - mean)
                           .cross(mesh.vertices[static_cast<std::size_t>(c)] - mean)) /
              6;
  }
  return volume;
}

}  // namespace frond
