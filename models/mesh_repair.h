// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "models/tessellation.h"

namespace frond {

// What is wrong with a mesh, counted, with the first offender of each kind (an index; -1: none).
struct MeshDefects {
  int duplicate_vertices = 0, first_duplicate_vertex = -1;  // with the coordinates of an earlier one
  int degenerate_faces = 0, first_degenerate_face = -1;     // with a corner twice, or without area
  int duplicate_faces = 0, first_duplicate_face = -1;  // with the corners of an earlier one, in any order
  int unreferenced_vertices = 0, first_unreferenced_vertex = -1;

  bool none() const {
    return duplicate_vertices + degenerate_faces + duplicate_faces + unreferenced_vertices == 0;
  }
  std::string InWords() const;  // "2 duplicate vertices (first: vertex 17), …"
};

// A face has no area where twice it is no more than 1e-12 of its longest side squared.
MeshDefects FindMeshDefects(const SurfaceMesh& mesh);

// What RepairMesh did.
struct MeshRepairCounts {
  int welded_vertices = 0;        // made one with an earlier one
  int degenerate_faces = 0;       // dropped
  int duplicate_faces = 0;        // dropped
  int swapped_edges = 0;          // to get rid of faces without area whose corners are three
  int split_vertices = 0;         // added, to part faces that touch in a vertex alone
  int unreferenced_vertices = 0;  // dropped
};

// Welds vertices with equal coordinates, drops faces that lose a corner by it, and of faces with the same
// three corners as many as cancel or repeat each other (both of a pair with opposite turns, which is a flap
// without thickness; one of a pair alike). Weldings after which an edge has more than two faces are taken
// back. A face without area between three vertices goes by swapping its longest side, or is dropped where
// that side is on the boundary. Vertices with several fans of faces are split (Guéziec et al. 2001, "Cutting
// and stitching"), vertices without faces dropped. The others keep their order. Normals and parameters are
// not kept. O(n log n).
SurfaceMesh RepairMesh(const SurfaceMesh& mesh, MeshRepairCounts* counts = nullptr);

// Gives each fan of faces at a vertex but the first a vertex of its own, at the end; returns how many.
int SplitPinchedVertices(SurfaceMesh* mesh);

// The mesh without the vertices that no face has; the others keep their order.
SurfaceMesh WithoutUnreferenced(const SurfaceMesh& mesh);

}  // namespace frond
