// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "models/mesh_edges.h"

namespace frond {
namespace {

using Triangle = std::array<int, 3>;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

bool HasCornerTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

bool HasNoArea(const SurfaceMesh& mesh, const Triangle& t) {
  const Eigen::Vector3d a = mesh.vertices[At(t[1])] - mesh.vertices[At(t[0])];
  const Eigen::Vector3d b = mesh.vertices[At(t[2])] - mesh.vertices[At(t[0])];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return a.cross(b).norm() <= 1e-12 * longest;
}

// By vertex the first one with the same coordinates.
std::vector<int> FirstEqualVertex(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<int> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int v) {
    const Eigen::Vector3d& p = vertices[At(v)];
    return std::tuple(p.x(), p.y(), p.z());
  };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && place(order[k]) == place(order[k - 1]);
    first[At(order[k])] = same ? first[At(order[k - 1])] : order[k];
  }
  return first;
}

// Faces with the same three corners: their sorted corners, whether sorting them is an odd permutation, and
// their number; equal ones next to each other, in order.
struct SortedFace {
  Triangle corners = {};
  bool odd = false;
  int face = 0;
};

std::vector<SortedFace> SortedFaces(const std::vector<Triangle>& triangles) {
  std::vector<SortedFace> faces;
  faces.reserve(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    SortedFace face{triangles[f], false, static_cast<int>(f)};
    auto& [a, b, c] = face.corners;
    for (auto [low, high] : {std::pair(&a, &b), std::pair(&b, &c), std::pair(&a, &b)}) {
      if (*high < *low) {
        std::swap(*low, *high);
        face.odd = !face.odd;
      }
    }
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end(), [](const SortedFace& a, const SortedFace& b) {
    return std::tie(a.corners, a.face) < std::tie(b.corners, b.face);
  });
  return faces;
}

int DropDegenerate(std::vector<Triangle>* triangles) {
  return static_cast<int>(std::erase_if(*triangles, HasCornerTwice));
}

// Of each set of faces with the same corners one is left where more turn one way than the other, else none.
int DropDuplicates(std::vector<Triangle>* triangles) {
  const std::vector<SortedFace> faces = SortedFaces(*triangles);
  std::vector<std::uint8_t> drop(triangles->size(), 0);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i;
    int balance = 0;
    for (; j < faces.size() && faces[j].corners == faces[i].corners; ++j) balance += faces[j].odd ? -1 : 1;
    bool kept = balance == 0;  // nothing is left to keep
    for (; i < j; ++i) {
      const bool keep = !kept && faces[i].odd == (balance < 0);
      kept = kept || keep;
      drop[At(faces[i].face)] = !keep;
    }
  }
  std::size_t left = 0;
  for (std::size_t f = 0; f < drop.size(); ++f) {
    if (!drop[f]) (*triangles)[left++] = (*triangles)[f];
  }
  triangles->resize(left);
  return static_cast<int>(drop.size() - left);
}

// Welds all vertices but those of `apart` (by the first of the equal ones), then drops faces.
SurfaceMesh Welded(const SurfaceMesh& mesh, const std::vector<int>& first,
                   const std::vector<std::uint8_t>& apart, MeshRepairCounts* counts) {
  SurfaceMesh welded;
  welded.vertices = mesh.vertices;
  welded.triangles = mesh.triangles;
  const auto target = [&](int v) { return apart[At(first[At(v)])] ? v : first[At(v)]; };
  for (Triangle& triangle : welded.triangles) {
    for (int& corner : triangle) corner = target(corner);
  }
  *counts = {};
  for (int v = 0; v < static_cast<int>(first.size()); ++v) counts->welded_vertices += target(v) != v;
  counts->degenerate_faces = DropDegenerate(&welded.triangles);
  counts->duplicate_faces = DropDuplicates(&welded.triangles);
  return welded;
}

// Welded, but for groups of vertices at edges that would get more than two faces.
SurfaceMesh WeldedWhereManifold(const SurfaceMesh& mesh, MeshRepairCounts* counts) {
  const std::vector<int> first = FirstEqualVertex(mesh.vertices);
  std::vector<std::uint8_t> group(first.size(), 0), apart(first.size(), 0);
  for (int v = 0; v < static_cast<int>(first.size()); ++v) {
    if (first[At(v)] != v) group[At(first[At(v)])] = 1;
  }
  while (true) {
    SurfaceMesh welded = Welded(mesh, first, apart, counts);
    bool changed = false;
    ForEachEdge(TableOfEdges(welded), [&](int low, const HalfEdge* begin, const HalfEdge* end) {
      if (end - begin <= 2) return;
      for (const int v : {low, begin->high}) {
        if (!group[At(first[At(v)])] || apart[At(first[At(v)])]) continue;
        apart[At(first[At(v)])] = 1;
        changed = true;
      }
    });
    if (!changed) return welded;
  }
}

// Faces without area whose corners are three: c lies on the longest side ab, whose other face abd becomes acd
// and cbd. A face is changed once; true where any was.
bool SwapLongestSides(SurfaceMesh* mesh, MeshRepairCounts* counts) {
  const std::size_t faces = mesh->triangles.size();
  std::vector<std::uint8_t> touched(faces, 0), drop(faces, 0);
  const auto length = [&](int side) {
    return (mesh->vertices[At(MeshCorner(*mesh, NextSide(side)))] -
            mesh->vertices[At(MeshCorner(*mesh, side))])
        .squaredNorm();
  };
  std::vector<std::uint8_t> flat(faces);
  for (std::size_t f = 0; f < faces; ++f) flat[f] = HasNoArea(*mesh, mesh->triangles[f]);
  if (std::find(flat.begin(), flat.end(), 1) == flat.end()) return false;
  const EdgeTable table = TableOfEdges(*mesh);
  std::vector<Triangle> result = mesh->triangles;
  ForEachEdge(table, [&](int, const HalfEdge* begin, const HalfEdge* end) {
    for (const HalfEdge* half = begin; half < end && end - begin <= 2; ++half) {
      const std::size_t f = At(half->side / 3);
      const int second = NextSide(half->side), third = NextSide(second);
      const double own = length(half->side);
      if (!flat[f] || touched[f] || own < length(second) || own < length(third)) continue;
      if (end - begin == 1) {
        touched[f] = drop[f] = 1;
        ++counts->degenerate_faces;
        continue;
      }
      const int other = (half == begin ? begin + 1 : begin)->side;
      if (touched[At(other / 3)]) continue;
      const int a = MeshCorner(*mesh, other), b = MeshCorner(*mesh, NextSide(other));
      const int c = MeshCorner(*mesh, third), d = MeshCorner(*mesh, NextSide(NextSide(other)));
      if (c == d) continue;
      result[f] = {a, c, d};
      result[At(other / 3)] = {c, b, d};
      touched[f] = touched[At(other / 3)] = 1;
      ++counts->swapped_edges;
    }
  });
  mesh->triangles.clear();
  for (std::size_t f = 0; f < faces; ++f) {
    if (!drop[f]) mesh->triangles.push_back(result[f]);
  }
  return std::find(touched.begin(), touched.end(), 1) != touched.end();
}

std::string Counted(int count, const char* what, const char* element, int first) {
  return std::to_string(count) + " " + what + " (first: " + element + " " + std::to_string(first) + ")";
}

}  // namespace

std::string MeshDefects::InWords() const {
  std::string text;
  const auto add = [&](int count, const char* what, const char* element, int first) {
    if (count > 0) text += (text.empty() ? "" : ", ") + Counted(count, what, element, first);
  };
  add(duplicate_vertices, "duplicate vertices", "vertex", first_duplicate_vertex);
  add(degenerate_faces, "degenerate faces", "face", first_degenerate_face);
  add(duplicate_faces, "duplicate faces", "face", first_duplicate_face);
  add(unreferenced_vertices, "unreferenced vertices", "vertex", first_unreferenced_vertex);
  return text;
}

MeshDefects FindMeshDefects(const SurfaceMesh& mesh) {
  MeshDefects defects;
  const auto count = [](int place, int* number, int* first) {
    *first = ++*number == 1 ? place : std::min(*first, place);
  };
  const std::vector<int> equal = FirstEqualVertex(mesh.vertices);
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
    const Triangle& triangle = mesh.triangles[At(f)];
    for (const int corner : triangle) used[At(corner)] = 1;
    if (HasCornerTwice(triangle) || HasNoArea(mesh, triangle))
      count(f, &defects.degenerate_faces, &defects.first_degenerate_face);
  }
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    if (equal[At(v)] != v) count(v, &defects.duplicate_vertices, &defects.first_duplicate_vertex);
    if (!used[At(v)]) count(v, &defects.unreferenced_vertices, &defects.first_unreferenced_vertex);
  }
  const std::vector<SortedFace> faces = SortedFaces(mesh.triangles);
  for (std::size_t k = 1; k < faces.size(); ++k) {
    if (faces[k].corners == faces[k - 1].corners && !HasCornerTwice(faces[k].corners))
      count(faces[k].face, &defects.duplicate_faces, &defects.first_duplicate_face);
  }
  return defects;
}

SurfaceMesh WithoutUnreferenced(const SurfaceMesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  SurfaceMesh kept;
  kept.triangles = mesh.triangles;
  for (const Triangle& triangle : mesh.triangles) {
    for (const int corner : triangle) number[At(corner)] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(kept.vertices.size());
    kept.vertices.push_back(mesh.vertices[v]);
  }
  for (Triangle& triangle : kept.triangles) {
    for (int& corner : triangle) corner = number[At(corner)];
  }
  return kept;
}

int SplitPinchedVertices(SurfaceMesh* mesh) {
  const std::vector<int> fan_of = FansOfCorners(*mesh, TableOfEdges(*mesh));
  const std::size_t before = mesh->vertices.size();
  std::vector<int> first_fan(before, -1), vertex_of_fan(fan_of.size(), -1);
  for (std::size_t corner = 0; corner < fan_of.size(); ++corner) {
    int& v = mesh->triangles[corner / 3][corner % 3];
    if (first_fan[At(v)] < 0) first_fan[At(v)] = fan_of[corner];
    if (first_fan[At(v)] == fan_of[corner]) continue;
    int& own = vertex_of_fan[At(fan_of[corner])];
    if (own < 0) {
      own = static_cast<int>(mesh->vertices.size());
      mesh->vertices.push_back(Eigen::Vector3d(mesh->vertices[At(v)]));
    }
    v = own;
  }
  return static_cast<int>(mesh->vertices.size() - before);
}

SurfaceMesh RepairMesh(const SurfaceMesh& mesh, MeshRepairCounts* counts) {
  constexpr int kPasses = 8;  // faces in a row without area need some
  MeshRepairCounts done;
  SurfaceMesh repaired = WeldedWhereManifold(mesh, &done);
  for (int pass = 0; pass < kPasses && SwapLongestSides(&repaired, &done); ++pass) {
    done.duplicate_faces += DropDuplicates(&repaired.triangles);
  }
  done.split_vertices = SplitPinchedVertices(&repaired);
  const std::size_t before = repaired.vertices.size();
  repaired = WithoutUnreferenced(repaired);
  done.unreferenced_vertices = static_cast<int>(before - repaired.vertices.size()) - done.welded_vertices;
  if (counts != nullptr) *counts = done;
  return repaired;
}

}  // namespace frond
