// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace frond {

// Converts by extension: a surface (json, step, iges) to a surface or to a mesh (ply, obj, stl, glb); a curve
// (the same, told by the schema, or as the file has no face) to a curve or to a polyline (ply, obj); a cloud
// to a cloud (ply, xyz, asc, csv, txt); a mesh to a mesh. A .ply or .obj read for a text format is a cloud,
// for a mesh format a mesh if it has faces. Throws ConfigError where the pair makes no sense, InputError as
// readers and writers do.
void Convert(const std::filesystem::path& in, const std::filesystem::path& out);

}  // namespace frond
