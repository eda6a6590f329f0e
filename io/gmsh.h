// SPDX-License-Identifier: BSD-3-Clause
// Finite-element meshes by Gmsh (Geuzaine and Remacle 2009), run as a program: its licence is the GPL.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/fe_mesh.h"
#include "io/surface_json.h"

namespace frond {

// msh, inp, bdf, unv, vtk: the extensions that Gmsh writes.
const std::vector<std::string>& FeMeshFormats();

struct GmshOptions {
  double size = 1;      // of elements, in the surface's unit
  int order = 1;        // 1 or 2
  bool volume = false;  // tetrahedra inside a closed surface, instead of triangles on it
  std::vector<std::string> formats = {"msh"};
};

struct GmshMesh {
  FeMesh mesh;               // as it was written, all digits
  std::vector<double> sicn;  // of each element: signed inverse condition number, 1 the best, < 0 inside out
  std::string version;       // Gmsh's
};

// Meshes the surface (its inside, where trimmed) and writes folder/mesh.FORMAT, coordinates in the surface's
// unit; elements are in one group, `surface` or `volume`. Works in `folder`, which should be empty. The
// result is the same in every run and for every user: one thread, no settings from home. In inp, triangles
// are shells (S3, S6). Throws ConfigError where there is no program gmsh that runs, FitError where it fails
// or an element is inside out, InputError where the files cannot be written.
GmshMesh MeshByGmsh(const SurfaceDocument& document, const GmshOptions& options,
                    const std::filesystem::path& folder);

}  // namespace frond
