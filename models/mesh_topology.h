// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// Faces that hang together by common vertices. χ = V − E + F; the genus (the number of handles) from
// χ = 2 − 2 genus − rims, none where the part is not an orientable 2-manifold.
struct MeshComponent {
  int vertices = 0, edges = 0, faces = 0, rims = 0;
  int euler_characteristic = 0;
  std::optional<int> genus;
};

// What a triangle mesh is, by its indices alone but for the order of the loops. Vertices without a face do
// not count. A boundary edge has one face; an edge with more than two, or between a corner and itself, and a
// vertex whose faces make more than one fan, are not manifold.
struct MeshTopology {
  std::vector<MeshComponent> components;  // most faces first
  // Vertices along the rims, each loop with its faces on the left (where `oriented`) from its lowest index;
  // the longest in space first. Of use where `manifold`.
  std::vector<std::vector<int>> boundary_loops;
  int vertices = 0, edges = 0, faces = 0;
  int euler_characteristic = 0;
  std::optional<int> genus;  // summed over the components; none where one has none
  int boundary_edges = 0;
  int non_manifold_edges = 0, non_manifold_vertices = 0;
  bool closed = false;      // there are faces, and no edge has one face only
  bool manifold = false;    // a 2-manifold with or without boundary
  bool orientable = false;  // turning some faces over would make it `oriented`
  bool oriented = false;    // the two faces of each edge pass it in opposite directions
};

// Linear in time and memory for bounded valence. Indices have to be in range.
MeshTopology FindMeshTopology(const SurfaceMesh& mesh);

double MeshArea(const SurfaceMesh& mesh);

// The volume inside, positive where the faces run counter-clockwise seen from outside; of use for closed,
// oriented meshes. Summed about the vertices' mean, so that survey coordinates keep their precision.
double MeshVolume(const SurfaceMesh& mesh);

}  // namespace frond
