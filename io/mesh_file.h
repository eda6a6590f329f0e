// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// Written: ply, obj, stl, glb. Read: ply, obj, stl, off.
const std::vector<std::string>& MeshWriteExtensions();
const std::vector<std::string>& MeshReadExtensions();

// By extension: .ply (binary; double positions, float normals, and s, t where there are parameters), .obj,
// .stl (binary, float), .glb (metres, float32 around the mesh's centre, which is the node's translation, so
// that survey coordinates keep their precision). Normals and parameters may be absent. Throws InputError.
void WriteMesh(const std::filesystem::path& path, const SurfaceMesh& mesh, std::string_view unit);

// Faces with more than three corners are cut into fans; STL corners with equal coordinates are joined.
// Normals and parameters are left empty. Throws InputError naming the file and the place.
SurfaceMesh ReadMesh(const std::filesystem::path& path);

}  // namespace frond
