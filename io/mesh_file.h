// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/point_cloud_file.h"
#include "models/tessellation.h"

namespace frond {

// Written: ply, obj, stl, glb. Read: ply, obj, stl, off.
const std::vector<std::string>& MeshWriteExtensions();
const std::vector<std::string>& MeshReadExtensions();

// By extension: .ply (binary; double positions, float normals, and s, t where there are parameters), .obj,
// .stl (binary, float), .glb (metres, float32 around the mesh's centre, which is the node's translation, so
// that survey coordinates keep their precision). Normals and parameters may be absent. Throws InputError.
void WriteMesh(const std::filesystem::path& path, const SurfaceMesh& mesh, std::string_view unit);

// One number a vertex.
struct VertexScalar {
  std::string name;
  std::vector<double> values;
};

// A .ply as above with one more property (double) a vertex. Throws InputError.
void WritePlyMesh(const std::filesystem::path& path, const SurfaceMesh& mesh, const VertexScalar& scalar);

// Faces with more than three corners are cut into fans; STL corners with equal coordinates are joined.
// Normals and parameters are left empty. `report` (may be null) gets the format, the number of vertices as
// `rows`, and the file's hash. Throws InputError naming the file and the place.
SurfaceMesh ReadMesh(const std::filesystem::path& path, CloudReport* report = nullptr);

}  // namespace frond
