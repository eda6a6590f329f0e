// SPDX-License-Identifier: BSD-3-Clause
// Meshes from the bytes of a file; `path` is for messages. Vertices may be not finite. Each throws
// InputError.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// The vertices alone: what follows them is not looked at.
std::vector<Eigen::Vector3d> ParsePlyPoints(const std::filesystem::path& path, std::string_view bytes);

SurfaceMesh ParsePlyMesh(const std::filesystem::path& path, std::string_view bytes);
SurfaceMesh ParseObjMesh(const std::filesystem::path& path, std::string_view bytes);
SurfaceMesh ParseOffMesh(const std::filesystem::path& path, std::string_view bytes);
SurfaceMesh ParseStlMesh(const std::filesystem::path& path, std::string_view bytes);  // binary or text

}  // namespace frond
